// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "lib/log/channel_names.hpp"

namespace faultline {

/// Returns channels and column indices of joints that the columns name by words, not numbers, such as
/// "shoulder_pos", "elbow_pos" and "elbow_torque": joints in the order of their positions in the file, other
/// quantities by the same words. Empty unless at least two positions have words of their own, so that
/// "raw_pos" beside "pos" stays one joint.
std::vector<std::pair<Channel, int>> named_joints(const std::vector<std::string>& names,
                                                  const std::function<bool(int)>& is_free);

}  // namespace faultline
