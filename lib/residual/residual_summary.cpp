// SPDX-License-Identifier: MIT
#include "lib/residual/residual_summary.hpp"

#include <cmath>

namespace faultline {

void ResidualSummary::add(const Residuals& residuals) {
  sums_.resize(residuals.joints());
  for (int i = 0; i < residuals.count(); ++i) {
    const double time = residuals.time[i];
    if (time < from_s_ || time > to_s_) continue;
    for (int j = 0; j < residuals.joints(); ++j) {
      const double velocity = residuals.velocity(j, i), position = residuals.position(j, i);
      if (!std::isfinite(velocity) || !std::isfinite(position)) continue;
      Sums& sums = sums_[j];
      if (++sums.count == 1 || std::fabs(velocity) > sums.velocity_peak) {
        sums.velocity_peak = std::fabs(velocity);
        sums.velocity_peak_s = time;
      }
      sums.position_peak = std::max(sums.position_peak, std::fabs(position));
      sums.velocity2 += velocity * velocity;
      sums.position2 += position * position;
      if (std::isfinite(residuals.ratio(j, i))) sums.ratio += residuals.ratio(j, i);
    }
  }
}

std::vector<JointResidual> ResidualSummary::joints() const {
  std::vector<JointResidual> out;
  for (const Sums& sums : sums_) {
    JointResidual joint;
    joint.joint = static_cast<int>(out.size()) + 1;
    joint.count = sums.count;
    if (sums.count > 0) {
      const double count = static_cast<double>(sums.count);
      joint.velocity_rms = std::sqrt(sums.velocity2 / count);
      joint.velocity_peak = sums.velocity_peak;
      joint.velocity_peak_s = sums.velocity_peak_s;
      joint.position_rms = std::sqrt(sums.position2 / count);
      joint.position_peak = sums.position_peak;
      joint.mean_ratio = sums.ratio / count;
    }
    out.push_back(joint);
  }
  return out;
}

}  // namespace faultline
