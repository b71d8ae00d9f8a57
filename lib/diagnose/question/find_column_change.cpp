// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lib/core/statistics.hpp"
#include "lib/diagnose/question/check_interpretation.hpp"
#include "lib/diagnose/question/torque_balance.hpp"
#include "lib/plausibility/column_interpretation.hpp"

namespace faultline {
namespace {

constexpr double kAtOnset_s = 0.1;     // after the onset, which is an estimate: not tested
constexpr double kTimesWorse = 3.0;    // ratio to the misfit before the change, or of other columns
constexpr double kNothingLeft = 0.02;  // least misfit: below it, all interpretations are as good
constexpr double kActs = 0.05;         // share of the largest healthy torque: a torque that acts is larger

struct Sides {
  Log before, behind;
};

Sides sides_of(LogSource& log, double onset_s) {
  Sides out;
  log.rewind();
  for (Log segment; out.behind.rows() < kExcerptRows && log.next(segment);) {
    const auto onset = std::lower_bound(segment.time.begin(), segment.time.end(), onset_s);
    const auto first = std::upper_bound(onset, segment.time.end(), onset_s + kAtOnset_s);
    append(out.before, slice(segment, 0, static_cast<int>(onset - segment.time.begin())));
    append(out.behind, slice(segment, static_cast<int>(first - segment.time.begin()), segment.rows()));
    if (out.before.rows() > kExcerptRows)
      out.before = slice(out.before, out.before.rows() - kExcerptRows, out.before.rows());
  }
  log.rewind();
  if (out.behind.rows() > kExcerptRows) out.behind = slice(out.behind, 0, kExcerptRows);
  return out;
}

/// Returns the median misfit of each joint's blocks, at least kNothingLeft; NaN for a joint without a usable
/// block or with a velocity in another unit than its position.
std::vector<double> median_misfits(const std::vector<JointMatch>& fit) {
  std::vector<double> left;
  for (const JointMatch& joint : fit)
    left.push_back(joint.is_determined() && joint.velocity_factor == 1.0
                       ? std::max(upper_median(joint.misfits), kNothingLeft)
                       : std::nan(""));
  return left;
}

/// Whether the interpretation explains every joint that was explained before the change, and one of them far
/// better than the plain columns do. Arguments: misfits by joint (median_misfits()).
bool explains(const std::vector<double>& reading, const std::vector<double>& plain,
              const std::vector<double>& before) {
  bool better = false, any = false;
  for (std::size_t j = 0; j < reading.size(); ++j) {
    if (!std::isfinite(before[j]) || before[j] > kTorqueFits) continue;
    const bool is_determined = std::isfinite(reading[j]);
    if (is_determined && reading[j] > std::min(kTorqueFits, kTimesWorse * before[j])) return false;
    if (!is_determined && std::isfinite(plain[j])) return false;
    any = any || is_determined;
    better = better || (is_determined && (!std::isfinite(plain[j]) || plain[j] > kTimesWorse * reading[j]));
  }
  return any && better;
}

double largest(const std::vector<double>& values) {
  double out = 0.0;
  for (const double value : values) out = std::fmax(out, std::abs(value));  // NaN does not count
  return out;
}

/// Whether the interpretation makes the torque of a joint so small that it does not act: what it explains is
/// a joint that swings free.
bool lets_a_joint_swing(const Log& plain, const Log& converted, const KnownRobot& robot) {
  for (std::size_t j = 0; j < plain.tau.size(); ++j) {
    const double acts = kActs * robot.usual.torque_scale[j];
    if (largest(plain.tau[j]) > acts && largest(converted.tau[j]) < acts) return true;
  }
  return false;
}

}  // namespace

std::optional<ColumnChange> find_column_change(LogSource& log, const KnownRobot& robot, double onset_s) {
  const Sides sides = sides_of(log, onset_s);
  if (sides.before.rows() == 0 || sides.behind.rows() == 0 || sides.behind.tau.empty()) return {};
  const std::vector<double> before = median_misfits(fit_to_robot(sides.before, robot)),
                            plain = median_misfits(fit_to_robot(sides.behind, robot));
  const auto score = [&](const ColumnInterpretation&, const std::vector<Log>& logs) -> std::optional<double> {
    if (lets_a_joint_swing(sides.behind, logs.front(), robot)) return std::nullopt;
    const std::vector<JointMatch> fit = fit_to_robot(logs.front(), robot);
    const bool velocities_fit =
        std::ranges::all_of(fit, [](const JointMatch& joint) { return joint.velocity_factor == 1.0; });
    if (!velocities_fit || !explains(median_misfits(fit), plain, before)) return std::nullopt;
    return score_of(fit).log_mean;
  };
  const std::vector<ColumnInterpretation> interpretations = interpretations_by_known_robot(robot.chain());
  const ColumnInterpretation* best =
      best_interpretation(interpretations, {sides.behind}, {}, INFINITY, score);
  if (!best) return std::nullopt;
  return ColumnChange{sides.before.first_row + sides.before.rows() + 1, onset_s, best->what};
}

}  // namespace faultline
