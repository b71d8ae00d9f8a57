// SPDX-License-Identifier: MIT
#include "lib/core/error.hpp"

#include <utility>

#include "lib/core/text.hpp"

namespace faultline {

Error::Error(ErrorCode code, std::string where, const std::string& message)
    : std::runtime_error(brief(where.empty() ? message : where + ": " + message)),
      code_(code),
      where_(std::move(where)),
      message_(brief(message)) {}

}  // namespace faultline
