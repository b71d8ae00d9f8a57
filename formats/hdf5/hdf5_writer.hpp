// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "formats/log_writer.hpp"

namespace faultline {

/// Creates an HDF5 file with a dataset per quantity, see docs/formats-hdf5.md: chunks with checksums, written
/// when they are full.
std::unique_ptr<LogWriter> create_hdf5(const std::string& path);

}  // namespace faultline
