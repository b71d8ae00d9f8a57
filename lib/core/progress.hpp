// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

namespace faultline {

/// Told by long work how far it is: what is being done and the share done, 0 to 1. May be empty. Never called
/// from two threads at once.
using Progress = std::function<void(const std::string& what, double share)>;

}  // namespace faultline
