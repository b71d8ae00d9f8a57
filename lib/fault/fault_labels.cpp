// SPDX-License-Identifier: MIT
#include "lib/fault/fault_labels.hpp"

namespace faultline {

std::vector<FaultLabel> fault_labels(int joints, bool torque_is_measured) {
  std::vector<FaultLabel> labels;
  for (int k = 0; k < kFaultKinds; ++k) {
    const FaultDescription& fault = describe(static_cast<FaultKind>(k));
    const bool is_hidden = fault.hidden_by_measured_torque && torque_is_measured;
    if (fault.place == FaultPlace::nowhere || fault.kind == FaultKind::unknown || is_hidden) continue;
    for (int j = fault.place == FaultPlace::tip ? joints : 1; j <= joints; ++j)
      labels.push_back({fault.kind, j});
  }
  return labels;
}

}  // namespace faultline
