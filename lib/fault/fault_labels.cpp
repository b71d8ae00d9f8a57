// SPDX-License-Identifier: MIT
#include "lib/fault/fault_labels.hpp"

namespace faultline {

std::vector<FaultLabel> fault_labels(int joints, const std::vector<int>& payload_links,
                                     bool torque_is_measured) {
  std::vector<FaultLabel> labels;
  for (int k = 0; k < kFaultKinds; ++k) {
    const FaultDescription& fault = describe(static_cast<FaultKind>(k));
    const bool is_hidden = fault.hidden_by_measured_torque && torque_is_measured;
    if (fault.place == FaultPlace::nowhere || fault.kind == FaultKind::unknown || is_hidden) continue;
    if (fault.place == FaultPlace::link) {
      for (const int link : payload_links) labels.push_back({fault.kind, link + 1});
      continue;
    }
    for (int j = 1; j <= joints; ++j) labels.push_back({fault.kind, j});
  }
  return labels;
}

}  // namespace faultline
