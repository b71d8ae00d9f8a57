// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "formats/log_writer.hpp"

namespace faultline {

/// Creates comma-separated text: header `t,q1..,dq1..,tau1..`, further channels after them, the shortest
/// digits that restore the same double, an empty cell for a missing value.
std::unique_ptr<LogWriter> create_csv(const std::string& path);

}  // namespace faultline
