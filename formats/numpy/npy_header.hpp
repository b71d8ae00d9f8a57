// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/arrays/stored_arrays.hpp"
#include "formats/arrays/stored_content.hpp"
#include "lib/core/issue.hpp"

namespace faultline {

/// An .npy array, in a content of its own or in an .npz.
struct NpyArray {
  std::vector<StoredArray> arrays;  ///< one, or one per field of a structured array
  std::int64_t bytes = 0;           ///< of header and elements
};

/// The first bytes of every .npy file.
inline constexpr const char* kNpyMagic = "\x93NUMPY";

/// Reads the header of the array in the stream. Omitted parts and the reasons are reported in `issues`;
/// nullopt when the header cannot be read.
std::optional<NpyArray> read_npy_header(ContentStream& stream, const std::string& name, Issues& issues);

}  // namespace faultline
