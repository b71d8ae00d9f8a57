// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "formats/log_writer.hpp"

namespace faultline {

/// An HDF5 file with a dataset a quantity, see docs/formats-hdf5.md: chunks with checksums, written as they
/// fill.
std::unique_ptr<LogWriter> create_hdf5(const std::string& path);

}  // namespace faultline
