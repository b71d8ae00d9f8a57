// SPDX-License-Identifier: MIT
#include "lib/diagnose/curves/expected_joint.hpp"

#include <limits>

namespace faultline {

ExpectedJoint expected_joint(const HealthyResiduals& healthy, const Log& segment, int row,
                             const Residuals& residuals, int i, int joint) {
  ExpectedJoint expected;
  expected.q = segment.q[joint][row] - residuals.position(joint, i) * healthy.position_rms[joint];
  expected.dq = segment.dq.empty()
                    ? std::numeric_limits<double>::quiet_NaN()
                    : segment.dq[joint][row] - residuals.velocity(joint, i) * healthy.velocity_rms[joint];
  return expected;
}

}  // namespace faultline
