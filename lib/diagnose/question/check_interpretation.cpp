// SPDX-License-Identifier: MIT
#include "lib/diagnose/question/check_interpretation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/statistics.hpp"
#include "lib/diagnose/question/torque_balance.hpp"
#include "lib/log/log.hpp"
#include "lib/plausibility/column_interpretation.hpp"

namespace faultline {
namespace {

constexpr int kExcerpts = 25;         // stretches that are searched for a moment that fits, at most
constexpr int kFewExcerpts = 3;       // stretches, after which joints that never moved are not waited for
constexpr double kExplains = 0.2;     // largest misfit in the best moments of a right interpretation
constexpr double kNeverNear = 0.5;    // misfit in the best moments above which it is another robot
constexpr double kClearlyLess = 0.5;  // share of the plain columns' mean misfit that a better one stays below
constexpr double kLeastRange = 0.05;  // share of the healthy range: less is no motion
constexpr double kOtherUnit = 1.5;    // factor between logged and required torque that is another unit

/// The fit of a stretch to the robot, by joint, under one interpretation of its columns.
using Fit = std::vector<JointMatch>;

bool has_motion(const Fit& fit) { return std::ranges::any_of(fit, &JointMatch::is_determined); }

/// The first stretch of a log that moves, and the misfits of all stretches that were read.
struct Beginning {
  Log rows;
  Fit fit;                                // of `rows`
  std::vector<std::vector<double>> ever;  // misfits of all blocks that were read, by joint
  std::vector<bool> velocity_fits;        // by joint, where it first moved
  bool fitted = false;                    // every joint that moves had moments that fit

  bool has_every_joint() const {
    return std::none_of(ever.begin(), ever.end(), [](const auto& of_joint) { return of_joint.empty(); });
  }
};

void take(const Fit& now, Beginning& beginning) {
  bool any = false, all = true;
  for (std::size_t j = 0; j < now.size(); ++j) {
    std::vector<double>& ever = beginning.ever[j];
    if (ever.empty() && now[j].is_determined()) beginning.velocity_fits[j] = now[j].velocity_factor == 1.0;
    ever.insert(ever.end(), now[j].misfits.begin(), now[j].misfits.end());
    if (ever.empty()) continue;
    any = true;
    all = all && beginning.velocity_fits[j] && best_misfit(ever) < kTorqueFits;
  }
  beginning.fitted = any && all;
}

Log next_rows(LogSource& log, Log& rest) {
  Log rows = std::exchange(rest, {});
  for (Log segment; rows.rows() < kExcerptRows && log.next(segment);) append(rows, segment);
  if (rows.rows() > kExcerptRows) {
    rest = slice(rows, kExcerptRows, rows.rows());
    rows = slice(rows, 0, kExcerptRows);
  }
  return rows;
}

/// `first_motion`: reads only up to the first stretch that moves, which is enough for the test of the clock.
Beginning find_beginning(LogSource& log, const KnownRobot& robot, bool first_motion) {
  Beginning out;
  out.ever.resize(robot.joints());
  out.velocity_fits.resize(robot.joints(), true);
  Log rest;
  for (int i = 0; i < kExcerpts; ++i) {
    Log rows = next_rows(log, rest);
    if (rows.rows() == 0) break;
    Fit fit = fit_to_robot(rows, robot);
    take(fit, out);
    if (!has_motion(out.fit) && has_motion(fit)) {
      out.rows = std::move(rows);
      out.fit = std::move(fit);
    }
    if (first_motion && has_motion(out.fit)) break;
    if (!first_motion && out.fitted && (out.has_every_joint() || i + 1 >= kFewExcerpts)) break;
  }
  return out;
}

/// Whether an interpretation (`then`) has misfits for all joints for which the plain columns (`now`) have.
bool covers_joints_of(const Fit& then, const Fit& now) {
  for (std::size_t j = 0; j < now.size(); ++j)
    if (now[j].is_determined() && !then[j].is_determined()) return false;
  return true;
}

/// Returns the contradiction by the interpretation that explains the beginning best: every joint in its best
/// moments (`usually`: also as usual), and clearly better than the plain columns do. Empty if there is none.
LogMismatch best_explanation(const Beginning& beginning, const KnownRobot& robot,
                             const std::vector<ColumnInterpretation>& interpretations, bool usually) {
  std::vector<double> least_motion;
  for (int j = 0; j < robot.joints(); ++j)
    least_motion.push_back(kLeastRange * (robot.usual.q_high[j] - robot.usual.q_low[j]));
  const auto score = [&](const ColumnInterpretation&, const std::vector<Log>& logs) -> std::optional<double> {
    const Fit fit = fit_to_robot(logs.front(), robot);
    const FitScore then = score_of(fit);
    if (!covers_joints_of(fit, beginning.fit) || then.worst > kExplains ||
        (usually && then.usual > kTorqueFits))
      return std::nullopt;
    return then.log_mean;
  };
  const double clearly_better = score_of(beginning.fit).log_mean + elementary::log(kClearlyLess);
  const ColumnInterpretation* best =
      best_interpretation(interpretations, {beginning.rows}, least_motion, clearly_better, score);
  return best ? LogMismatch{best->what, best->cure, best->is_entry_of_columns} : LogMismatch{};
}

/// Tests whether the logged torques are the required ones times factors far from 1: at every joint if `all`,
/// else at most joints.
LogMismatch other_torque(const Fit& fit, bool all) {
  std::vector<std::string> ratios;
  int determined = 0, poor = 0, other = 0;
  for (std::size_t j = 0; j < fit.size(); ++j) {
    const double ratio = fit[j].torque_ratio;
    if (!fit[j].is_determined() || ratio == 0.0) continue;
    ++determined;
    if (fit[j].ratio_residual > kTorqueFits || ratio < 0.0) {
      ++poor;
      continue;
    }
    other += ratio > kOtherUnit || ratio < 1.0 / kOtherUnit;
    ratios.push_back(fmt::format("tau{} {:.3g}", Joint::at(static_cast<int>(j)), ratio));
  }
  const bool enough = all ? other == determined : poor <= (determined > 2 ? 1 : 0) && 2 * other >= determined;
  if (!enough || other < std::min(static_cast<int>(fit.size()), 2)) return {};
  return {fmt::format("the torques are another quantity or unit, such as a current, or a gear ratio is "
                      "missing: they are {} times the torques that this robot needs for its motion",
                      fmt::join(ratios, ", ")),
          "write unit or scale (torque of one logged unit) of each tau into [log.columns]", true};
}

LogMismatch other_velocity(const Fit& fit) {
  std::vector<std::string> factors;
  for (std::size_t j = 0; j < fit.size(); ++j)
    if (fit[j].is_determined() && fit[j].velocity_factor != 1.0)
      factors.push_back(fmt::format("dq{0} is {1:.4g} times the derivative of q{0}",
                                    Joint::at(static_cast<int>(j)), fit[j].velocity_factor));
  if (factors.empty()) return {};
  return {fmt::format("position, velocity and time are inconsistent: {}", fmt::join(factors, ", ")),
          "write their units into [log.columns], or correct the clock of the log"};
}

LogMismatch other_robot(const Beginning& beginning) {
  std::vector<Joint> far;
  const int joints = static_cast<int>(beginning.ever.size());
  for (int j = 0; j < joints; ++j)
    if (!beginning.ever[j].empty() && best_misfit(beginning.ever[j]) > kNeverNear)
      far.push_back(Joint::at(j));
  if (far.empty() || static_cast<int>(far.size()) < std::min(joints, 2)) return {};
  return {fmt::format("its torques never match the motion of this robot (joints {}), not even with other "
                      "units, signs or columns: another robot, tool or recording",
                      fmt::join(far, ", ")),
          "use the model and the robot file of the recorded robot"};
}

}  // namespace

LogMismatch check_clock(LogSource& log, const KnownRobot& robot, double sample_period_s) {
  log.rewind();
  const Beginning beginning = find_beginning(log, robot, true);
  log.rewind();
  if (!has_motion(beginning.fit)) return {};
  return best_explanation(beginning, robot, clock_interpretations(beginning.rows, sample_period_s), false);
}

LogMismatch check_interpretation(LogSource& log, const KnownRobot& robot) {
  log.rewind();
  const Beginning beginning = find_beginning(log, robot, false);
  log.rewind();
  if (!has_motion(beginning.fit)) return {};
  if (beginning.fitted || score_of(beginning.fit).worst < kTorqueFits)
    return other_torque(beginning.fit, true);
  LogMismatch best = best_explanation(beginning, robot, interpretations_by_known_robot(robot.chain()), false);
  if (best.is_empty()) best = best_explanation(beginning, robot, delay_interpretations(beginning.rows), true);
  for (const LogMismatch& mismatch :
       {best, other_torque(beginning.fit, false), other_velocity(beginning.fit)})
    if (!mismatch.is_empty()) return mismatch;
  return other_robot(beginning);
}

}  // namespace faultline
