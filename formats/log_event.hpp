// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace faultline {

/// An event during a log, for formats that store events beside the rows.
struct LogEvent {
  double time_s = 0.0;
  bool grave = false;  ///< an error rather than a remark
  std::string text;
};

}  // namespace faultline
