// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/hdf5/hdf5_library.hpp"

namespace faultline {

/// All dimensions of a dataset, and those that its shape keeps.
struct Hdf5Shape {
  std::vector<hsize_t> dimensions;
  std::vector<std::size_t> kept;
  std::vector<std::int64_t> shape;
};

/// Storage of the elements of a dataset. Vectors are along the kept dimensions.
struct Hdf5Storage {
  std::vector<std::int64_t> chunk;  ///< empty when it is in one piece
  std::int64_t chunk_bytes = 0;
  std::vector<std::int64_t> held;  ///< of chunked ones, up to the last chunks written
  bool unwritten = false;          ///< there is room for elements, but none was written
  bool has_holes = false;          ///< some chunks were never written
  std::int64_t elements_held = 0;  ///< of others: number from the front that the file can hold
};

/// Returns nullopt, with `why`, when the elements cannot be read.
std::optional<Hdf5Storage> hdf5_storage(hid_t dataset, const Hdf5Shape& shape, std::int64_t file_bytes,
                                        std::string& why);

}  // namespace faultline
