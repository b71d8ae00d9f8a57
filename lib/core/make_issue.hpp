// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>

#include "lib/core/issue.hpp"

namespace faultline {

/// Returns an issue of a whole log or of one `channel`, without a row.
inline Issue make_issue(std::string code, Severity severity, std::string message, std::string channel = "") {
  Issue issue;
  issue.code = std::move(code);
  issue.channel = std::move(channel);
  issue.severity = severity;
  issue.message = std::move(message);
  return issue;
}

}  // namespace faultline
