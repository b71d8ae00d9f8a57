// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/hdf5/hdf5_library.hpp"

namespace faultline {

/// Dimensions of a dataset, all, and those that are kept as its shape.
struct Hdf5Shape {
  std::vector<hsize_t> dimensions;
  std::vector<std::size_t> kept;
  std::vector<std::int64_t> shape;
};

/// How the elements of a dataset are stored. Vectors are along the kept dimensions.
struct Hdf5Storage {
  std::vector<std::int64_t> chunk;  ///< empty when it is in one piece
  std::int64_t chunk_bytes = 0;
  std::vector<std::int64_t> held;  ///< of chunked ones, up to where chunks were written
  bool unwritten = false;          ///< there is room for elements, but none was written
  bool has_holes = false;          ///< some chunks were never written
  std::int64_t elements_held = 0;  ///< of others: from the front on, that the file can hold
};

/// Nullopt, with `why`, when the elements cannot be read.
std::optional<Hdf5Storage> hdf5_storage(hid_t dataset, const Hdf5Shape& shape, std::int64_t file_bytes,
                                        std::string& why);

}  // namespace faultline
