// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "formats/log_writer.hpp"

namespace faultline {

/// An .npz file for numpy.load(), see docs/formats-numpy.md. The whole log is kept in memory until commit().
std::unique_ptr<LogWriter> create_npz(const std::string& path);

}  // namespace faultline
