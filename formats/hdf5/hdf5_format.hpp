// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "formats/arrays/array_file.hpp"
#include "formats/byte_source.hpp"
#include "formats/log_writer.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// True when the file is HDF5, also after a block that another program put before it.
bool looks_like_hdf5(std::string_view head);

/// Opens the datasets of an HDF5 file, see docs/formats-hdf5.md. Throws Error(input) when it has none that
/// can be read.
std::unique_ptr<RawReader> open_hdf5(std::unique_ptr<ByteSource> bytes);

/// Converts the path of a dataset to the name that MATLAB shows; MATLAB stores matrices transposed.
using MatlabNaming = std::string (*)(const std::string& path);

/// Opens the datasets; `matlab` is null for an ordinary file.
std::unique_ptr<ArrayFile> open_hdf5_arrays(const std::string& path, MatlabNaming matlab);

/// Creates an HDF5 file with a dataset per quantity, see docs/formats-hdf5.md: chunks with checksums, written
/// when they are full.
std::unique_ptr<LogWriter> create_hdf5(const std::string& path);

}  // namespace faultline
