// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "lib/log/log_source.hpp"

namespace faultline {

struct ResampleOptions {
  double period_s = 0.001;  ///< between the new rows, which start at the first recorded time
  /// Torque between two samples: held (0) to a straight line (0.5), see MotionModel::torque_phi.
  double torque_phi = 0.0;
};

/// Returns the log at a fixed sample period, as a slower recorder would have written it: positions,
/// velocities and extra channels are interpolated linearly between neighbouring samples. A torque is its mean
/// over one new period, which keeps the impulse from row to row, so that no short torque is lost or counted
/// twice. A value is missing if one of its inputs is. No rows are made inside gaps, which are recorded steps
/// longer than 3 times the longer of both periods, or beyond the last sample. `rows_read` and the issues are
/// those of the recorded log. Throws Error(usage) unless the period is positive. `source` outlives the
/// result.
std::unique_ptr<LogSource> resampled(LogSource& source, const ResampleOptions& options);

}  // namespace faultline
