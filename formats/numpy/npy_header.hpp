// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/arrays/stored_arrays.hpp"

namespace faultline {

/// An .npy array, in a content of its own or of a .npz.
struct NpyArray {
  std::vector<StoredArray> arrays;  ///< one, or one a field of a structured array
  std::int64_t bytes = 0;           ///< of header and elements
};

/// What begins every .npy file.
inline constexpr const char* kNpyMagic = "\x93NUMPY";

/// Reads the header of the array that the stream holds. What is left out, and why, is told in `issues`;
/// nullopt when the header cannot be read.
std::optional<NpyArray> read_npy_header(ContentStream& stream, const std::string& name, Issues& issues);

}  // namespace faultline
