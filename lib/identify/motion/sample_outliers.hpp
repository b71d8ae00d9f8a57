// SPDX-License-Identifier: MIT
#pragma once

#include "lib/identify/motion/motion_smoother.hpp"
#include "lib/identify/motion/raw_stretch.hpp"

namespace faultline {

/// Returns the samples of one joint, with outliers and stale rows marked in `q_off` and `dq_off`.
JointMotion joint_motion(const RawStretch& stretch, int joint);

}  // namespace faultline
