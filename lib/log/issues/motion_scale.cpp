// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lib/core/make_issue.hpp"
#include "lib/core/statistics.hpp"
#include "lib/log/issues/quality_issues.hpp"

namespace faultline {
namespace {

constexpr double kOneMotion = 0.98;      // least correlation of position and velocity for a meaningful factor
constexpr double kLeastOff = 0.004;      // difference of the factor from 1; healthy logs have less
constexpr double kSurelyOff = 5.0;       // the same in standard deviations
constexpr double kOneScale = 0.002;      // between factors of two joints; errors of integrals are smaller
constexpr double kScaleDoubts = 3.0;     // the same in standard deviations
constexpr double kShareAlike = 2.0 / 3;  // of the moving joints: the sensor of one may drift

}  // namespace

void judge_motion_scale(const std::vector<VelocityAgreement>& agreements, Issues& issues) {
  std::vector<VelocityAgreement> moving;
  std::vector<double> factors;
  for (const VelocityAgreement& joint : agreements)
    if (joint.verdict == VelocityVerdict::agrees && joint.correlation > kOneMotion) {
      moving.push_back(joint);
      factors.push_back(joint.factor);
    }
  if (moving.size() < 2) return;
  const double factor = upper_median(factors);
  double least_std = std::numeric_limits<double>::infinity();
  int alike = 0;
  for (const VelocityAgreement& joint : moving) {
    if (std::abs(joint.factor - factor) > std::max(kScaleDoubts * joint.factor_std, kOneScale)) continue;
    least_std = std::min(least_std, joint.factor_std);
    ++alike;
  }
  const auto enough = std::max(2.0, kShareAlike * static_cast<double>(moving.size()));
  if (alike < enough || std::abs(factor - 1.0) < std::max(kLeastOff, kSurelyOff * least_std)) return;
  issues.add(make_issue(kScaledMotion, Severity::warning,
                        fmt::format("the positions of {} of {} moving joints change {:.4f} times as fast as "
                                    "their velocities: the clock or the positions are scaled. If the clock "
                                    "is scaled, correct it in the robot file, [log.columns] t = {{scale = "
                                    "{:.4f}}}; if the positions are, use {{scale = {:.4f}}} for each of them",
                                    alike, moving.size(), factor, factor, 1.0 / factor)));
}

}  // namespace faultline
