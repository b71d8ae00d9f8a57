// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>

#include "lib/fault/fault_catalogue.hpp"

namespace faultline {

/// Returns kind and joint in words, such as "joint 2 swings freely (no torque)" or "unknown fault".
std::string plain_words(const FaultLabel& label);

/// Returns what to check next: sentences for a technician.
std::string next_check_for(const FaultLabel& label);

/// Returns the size of the fault in words, such as "about 40 % of the torque is lost"; empty for kinds
/// without such words. `sizes` as in the catalogue, at a joint that turns or slides.
std::string size_text(const FaultLabel& label, const std::array<double, kMostSizes>& sizes, bool turns);

}  // namespace faultline
