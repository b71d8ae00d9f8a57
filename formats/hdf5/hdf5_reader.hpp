// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "formats/arrays/array_file.hpp"
#include "formats/byte_source.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// Whether the file, or what follows a block of its program's own, is HDF5.
bool looks_like_hdf5(std::string_view head);

/// Opens the datasets of an HDF5 file, see docs/formats-hdf5.md. Throws Error(input) when it holds none that
/// can be read.
std::unique_ptr<RawReader> open_hdf5(std::unique_ptr<ByteSource> bytes);

/// How a path of a file's own program is written, when that is MATLAB, which stores matrices transposed.
using MatlabNaming = std::string (*)(const std::string& path);

/// The datasets; `matlab` is null for an ordinary file.
std::unique_ptr<ArrayFile> open_hdf5_arrays(const std::string& path, MatlabNaming matlab);

}  // namespace faultline
