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

/// Returns the scales that suit the rate and the noise of the logs. The kernel is the shortest of the rate,
/// or a wider one if the noise of a joint's acceleration, as that of a coarse encoder, would spoil the
/// estimated inertias. `logs` have the samples as recorded; `derived` is true for a joint whose velocity was
/// computed from its position.
RowScale row_scale(const std::vector<UniformLog>& logs, const std::vector<bool>& derived);

}  // namespace faultline
