// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/core/issue.hpp"

namespace faultline {

/// Why a log with `found` positions does not fit `whose` robot of `wanted` joints, such as "the model": the
/// position that has no column where the log's issues name one, else perhaps another robot.
std::string joint_count_sentence(const Issues& issues, int found, const std::string& whose, int wanted);

}  // namespace faultline
