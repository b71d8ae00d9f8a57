// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "formats/log_writer.hpp"

namespace faultline {

/// Creates an .npz file for numpy.load(), see docs/formats-numpy.md. The log is in memory until commit().
std::unique_ptr<LogWriter> create_npz(const std::string& path);

}  // namespace faultline
