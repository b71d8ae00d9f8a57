// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/reproduce/protocol/protocol.hpp"

/// Explanations below the tables on detection at any time.
namespace faultline::run_texts {

std::string detectors(ControllerVariant controller);
std::string trade_off();
std::string comparison();

}  // namespace faultline::run_texts
