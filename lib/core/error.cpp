// SPDX-License-Identifier: MIT
#include "lib/core/error.hpp"

namespace faultline {

Error::Error(ErrorCode code, std::string where, std::string message)
    : std::runtime_error(where.empty() ? message : where + ": " + message),
      code_(code),
      where_(std::move(where)),
      message_(std::move(message)) {}

}  // namespace faultline
