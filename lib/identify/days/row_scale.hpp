// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/balance/uniform_log.hpp"

namespace faultline {

/// Time scales of the rows of a robot.
struct RowScale {
  double kernel_s = 0.0;    ///< standard deviation of the kernel (RowSetting::kernel_s)
  double friction_s = 0.0;  ///< the same for the velocity that friction depends on
  int averaged = 1;         ///< recorded samples that become one: the kernel does not distinguish finer ones
};

/// Returns the scales that suit the rate and the noise of the logs: the shortest kernel with which the noise
/// of each joint's acceleration is small beside the acceleration itself. With a shorter one, the noise of a
/// coarse encoder would act as an error of the regressors and make the estimated inertias too small. `logs`
/// have the samples as recorded; `derived` is true for a joint whose velocity was computed from its position.
RowScale row_scale(const std::vector<UniformLog>& logs, const std::vector<bool>& derived);

}  // namespace faultline
