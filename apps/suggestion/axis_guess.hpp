// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "apps/suggestion/robot_guess.hpp"
#include "apps/suggestion/unit_guess.hpp"

namespace faultline {

/// Whether a joint turns or slides; `header` is its position's unit in the file, empty for none.
GuessedAxis guess_axis(const JointNumbers& joint, const GuessedUnits& units, const std::string& header);

}  // namespace faultline
