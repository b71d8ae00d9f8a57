// SPDX-License-Identifier: MIT
#pragma once

#include "lib/identify/motion/motion_smoother.hpp"
#include "lib/identify/motion/raw_stretch.hpp"

namespace faultline {

/// The samples of one joint, those that stand off their neighbours and stale rows switched off.
JointMotion joint_motion(const RawStretch& stretch, int joint);

}  // namespace faultline
