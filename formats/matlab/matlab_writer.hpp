// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "formats/log_writer.hpp"

namespace faultline {

/// Creates a MATLAB file of version 5 (as save -v6 does), see docs/formats-matlab.md. The whole log is kept
/// in memory until commit(), which throws Error(output) when an array is larger than such a file may hold.
std::unique_ptr<LogWriter> create_matlab(const std::string& path);

}  // namespace faultline
