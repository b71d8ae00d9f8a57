// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/core/issue.hpp"

namespace faultline {

/// Returns why a log with `found` positions does not fit `whose` robot (such as "the model") of `wanted`
/// joints: the position without a column if the log's issues name one, else perhaps another robot.
std::string joint_count_sentence(const Issues& issues, int found, const std::string& whose, int wanted);

}  // namespace faultline
