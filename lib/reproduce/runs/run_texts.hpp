// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/reproduce/protocol/protocol.hpp"

/// What readers of the tables on detection at any time are told.
namespace faultline::run_texts {

std::string detectors(ControllerVariant controller);
std::string trade_off();
std::string comparison();

}  // namespace faultline::run_texts
