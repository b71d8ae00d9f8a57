// SPDX-License-Identifier: MIT
#include "lib/diagnose/question/check_interpretation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/statistics.hpp"
#include "lib/diagnose/question/torque_balance.hpp"
#include "lib/log/log.hpp"
#include "lib/plausibility/column_interpretation.hpp"

namespace faultline {
namespace {

constexpr int kRows = 4000;            // rows of a stretch that is tested at once
constexpr int kExcerpts = 25;          // stretches that are searched for a moment that fits, at most
constexpr int kFewExcerpts = 3;        // stretches, after which joints that never moved are not waited for
constexpr double kReadingFits = 0.35;  // misfit of a joint below which its torque is as the model predicts
constexpr double kExplains = 0.2;      // largest misfit in the best moments of a right interpretation
constexpr double kFitsWell = 0.06;     // misfit below which one moment is enough
constexpr double kNeverNear = 0.5;     // misfit in the best moments above which it is another robot
constexpr double kClearlyLess = 0.5;  // share of the plain columns' mean misfit that a better one stays below
constexpr double kLeastRange = 0.05;  // share of the healthy range: less is no motion
constexpr double kOtherUnit = 1.5;    // factor between logged and required torque that is another unit

constexpr double kOtherClock = 1.3;  // ratio to the period of the model's logs above which clocks differ

double period_of(const Log& rows) { return (rows.time.back() - rows.time.front()) / (rows.rows() - 1); }

/// Ratio of the period of the rows to that of the model's logs; 1 if it is within kOtherClock.
double clock_ratio(const Log& rows, double sample_period_s) {
  if (rows.rows() < 2) return 1.0;
  const double ratio = period_of(rows) / sample_period_s;
  return ratio > kOtherClock || ratio < 1.0 / kOtherClock ? ratio : 1.0;
}

/// Returns the interpretation that stamps run `ratio` times too fast; none for a ratio of 1.
std::vector<ColumnInterpretation> clock_interpretations(double ratio, double sample_period_s) {
  if (ratio == 1.0) return {};
  constexpr double kMilli = 1e-3, kNear = 0.05;  // s in a ms; relative error of a ratio that counts as ms
  const bool in_ms = std::abs(ratio * kMilli - 1.0) < kNear;
  ColumnInterpretation reading;
  reading.what =
      in_ms ? "the time is in milliseconds"
            : fmt::format("its time runs {:.4g} times too {}: the motion fits a row every {:.4g} s",
                          std::max(ratio, 1.0 / ratio), ratio > 1.0 ? "fast" : "slow", sample_period_s);
  reading.cure =
      in_ms ? "write unit = \"ms\" for t into [log.columns]"
            : fmt::format("write scale = {:.6g} for t into [log.columns], or correct the clock of the log",
                          1.0 / ratio);
  reading.is_entry_of_columns = in_ms;
  reading.apply = [ratio](Log& log) {
    for (double& t : log.time) t /= ratio;
  };
  return {reading};
}

/// Returns torques logged late or early by two rows to a quarter of `rows`, in steps of a third.
std::vector<ColumnInterpretation> delay_interpretations(const Log& rows) {
  // Rows: the first delay tried; the next is a third longer each time, up to a quarter of the log.
  constexpr int kFirstStep = 2, kFiner = 3, kShortest = 4;
  const double period = period_of(rows);
  std::vector<ColumnInterpretation> out;
  for (int step = kFirstStep; kShortest * step < rows.rows(); step += std::max(1, step / kFiner))
    for (const int shift : {step, -step}) {
      out.push_back({fmt::format("the torques are logged about {:.2g} s too {}", std::abs(shift) * period,
                                 shift > 0 ? "late" : "early"),
                     "record torque and motion with one clock, or shift the torque before the diagnosis",
                     [shift](Log& log) {
                       for (std::vector<double>& tau : log.tau) {
                         const std::vector<double> logged = tau;
                         const int last = static_cast<int>(tau.size()) - 1;
                         for (int k = 0; k <= last; ++k) tau[k] = logged[std::clamp(k + shift, 0, last)];
                       }
                     }});
    }
  return out;
}

/// The fit of a stretch to the robot, by joint, under one interpretation of its columns.
struct Fit {
  std::vector<std::vector<double>> misfits;  // of its blocks, by joint
  std::vector<double> velocity_factor;
  std::vector<TorqueRatio> ratio;

  int joints() const { return static_cast<int>(misfits.size()); }
  bool is_determined(int j) const { return !misfits[j].empty(); }
  bool has_motion() const {
    return std::any_of(misfits.begin(), misfits.end(),
                       [](const auto& of_joint) { return !of_joint.empty(); });
  }
};

Fit fit_of(const Log& log, const KnownRobot& robot) {
  Fit fit;
  const std::vector<JointBalance> balance = torque_balance(log, robot);
  for (int j = 0; j < robot.joints(); ++j) {
    const double scale = robot.usual.torque_scale[j];
    fit.misfits.push_back(scale > 0.0 ? misfits(balance[j], scale) : std::vector<double>{});
    fit.velocity_factor.push_back(balance[j].velocity_factor);
    fit.ratio.push_back(torque_ratio(balance[j], scale));
  }
  return fit;
}

/// The misfit that `count` blocks do not exceed; with fewer blocks, the largest. 0 without any.
double best_blocks(std::vector<double> of_joint, std::size_t count) {
  if (of_joint.empty()) return 0.0;
  const std::size_t last = std::min(count, of_joint.size()) - 1;
  std::nth_element(of_joint.begin(), of_joint.begin() + static_cast<std::ptrdiff_t>(last), of_joint.end());
  return of_joint[last];
}

/// The misfit in the best moment of a joint: of a block that fits well, else of two successive blocks, since
/// one may fit by chance.
double best_misfit(const std::vector<double>& of_joint) {
  const double best = best_blocks(of_joint, 1);
  if (best < kFitsWell || of_joint.size() < 2) return best;
  double pair = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < of_joint.size(); ++i)
    pair = std::min(pair, std::max(of_joint[i - 1], of_joint[i]));
  return pair;
}

/// The misfit that a third of the blocks, at least two, do not exceed: a fault may begin soon.
double usual_misfit(const std::vector<double>& of_joint) {
  return best_blocks(of_joint, std::max((of_joint.size() + 2) / 3, std::size_t{2}));
}

/// The fit of an interpretation: largest best_misfit() and usual_misfit() of a joint, and the mean logarithm
/// of both over the joints.
struct Score {
  double worst = 0.0, usual = 0.0, log_mean = 0.0;
};

Score score_of(const Fit& fit) {
  constexpr double kLeast = 1e-2;  // least misfit: below it, all interpretations are right
  Score out;
  int determined = 0;
  for (int j = 0; j < fit.joints(); ++j) {
    if (!fit.is_determined(j)) continue;
    const double apart = fit.velocity_factor[j] == 1.0 ? 0.0 : 2.0 * kNeverNear;
    const double best = std::max(best_misfit(fit.misfits[j]), apart);
    const double usual = std::max(usual_misfit(fit.misfits[j]), apart);
    out.worst = std::max(out.worst, best);
    out.usual = std::max(out.usual, usual);
    out.log_mean +=
        0.5 * (elementary::log(std::max(best, kLeast)) + elementary::log(std::max(usual, kLeast)));
    ++determined;
  }
  if (determined > 0) out.log_mean /= determined;
  return out;
}

/// The first stretch of a log that moves, and the misfits of all stretches that were read.
struct Beginning {
  Log rows;
  Fit fit;                                // of `rows`
  std::vector<std::vector<double>> ever;  // misfits of all blocks that were read, by joint
  std::vector<bool> velocity_fits;        // by joint, where it first moved
  bool fitted = false;                    // every joint that moves had moments that fit

  bool is_determined(int j) const { return !ever[j].empty(); }
  bool has_every_joint() const {
    return std::none_of(ever.begin(), ever.end(), [](const auto& of_joint) { return of_joint.empty(); });
  }
};

void take(const Fit& now, Beginning& beginning) {
  bool any = false, all = true;
  for (int j = 0; j < now.joints(); ++j) {
    if (!beginning.is_determined(j) && now.is_determined(j))
      beginning.velocity_fits[j] = now.velocity_factor[j] == 1.0;
    std::vector<double>& ever = beginning.ever[j];
    ever.insert(ever.end(), now.misfits[j].begin(), now.misfits[j].end());
    if (ever.empty()) continue;
    any = true;
    all = all && beginning.velocity_fits[j] && best_misfit(ever) < kReadingFits;
  }
  beginning.fitted = any && all;
}

Log next_rows(LogSource& log, Log& rest) {
  Log rows = std::exchange(rest, {});
  for (Log segment; rows.rows() < kRows && log.next(segment);) append(rows, segment);
  if (rows.rows() > kRows) {
    rest = slice(rows, kRows, rows.rows());
    rows = slice(rows, 0, kRows);
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
    Fit fit = fit_of(rows, robot);
    take(fit, out);
    if (!out.fit.has_motion() && fit.has_motion()) {
      out.rows = std::move(rows);
      out.fit = std::move(fit);
    }
    if (first_motion && out.fit.has_motion()) break;
    if (!first_motion && out.fitted && (out.has_every_joint() || i + 1 >= kFewExcerpts)) break;
  }
  return out;
}

/// Whether an interpretation (`then`) has misfits for all joints for which the plain columns (`now`) have.
bool covers_joints_of(const Fit& then, const Fit& now) {
  for (int j = 0; j < now.joints(); ++j)
    if (now.is_determined(j) && !then.is_determined(j)) return false;
  return true;
}

/// Whether an interpretation makes the motion of a joint far smaller than in the healthy logs.
bool shrinks_motion(const Log& rows, const Log& read, const KnownRobot& robot) {
  const auto range = [](const std::vector<double>& q) {
    const auto [low, high] = std::minmax_element(q.begin(), q.end());
    return *high - *low;
  };
  for (int j = 0; j < robot.joints(); ++j) {
    const double least = kLeastRange * (robot.usual.q_high[j] - robot.usual.q_low[j]);
    if (range(read.q[j]) < least && range(rows.q[j]) >= least) return true;
  }
  return false;
}

/// The best interpretation so far.
struct Best {
  LogMismatch doubt;  ///< empty while none is clearly better than the plain columns
  double log_mean = 0.0;
};

/// The mean logarithm that an interpretation must stay below to be clearly better than the plain columns.
Best clearly_better_than(const Beginning& beginning) {
  return {{}, score_of(beginning.fit).log_mean + elementary::log(kClearlyLess)};
}

/// Sets `best` to the best interpretation that explains every joint in its best moments (`usually`: also as
/// usual), and clearly better than before.
void try_interpretations(const Beginning& beginning, const KnownRobot& robot,
                         const std::vector<ColumnInterpretation>& readings, bool usually, Best& best) {
  for (const ColumnInterpretation& reading : readings) {
    Log rows = beginning.rows;
    reading.apply(rows);
    if (shrinks_motion(beginning.rows, rows, robot)) continue;
    const Fit fit = fit_of(rows, robot);
    const Score then = score_of(fit);
    if (!covers_joints_of(fit, beginning.fit) || then.worst > kExplains ||
        (usually && then.usual > kReadingFits) || then.log_mean >= best.log_mean)
      continue;
    best = {{reading.what, reading.cure, reading.is_entry_of_columns}, then.log_mean};
  }
}

/// Tests whether the logged torques are the required ones times factors far from 1: at every joint if `all`,
/// else at most joints.
LogMismatch other_torque(const Fit& fit, bool all) {
  std::vector<std::string> ratios;
  int determined = 0, poor = 0, other = 0;
  for (int j = 0; j < fit.joints(); ++j) {
    const TorqueRatio& torque = fit.ratio[j];
    if (!fit.is_determined(j) || torque.ratio == 0.0) continue;
    ++determined;
    if (torque.left > kReadingFits || torque.ratio < 0.0) {
      ++poor;
      continue;
    }
    other += torque.ratio > kOtherUnit || torque.ratio < 1.0 / kOtherUnit;
    ratios.push_back(fmt::format("tau{} {:.3g}", j + 1, torque.ratio));
  }
  const bool enough = all ? other == determined : poor <= (determined > 2 ? 1 : 0) && 2 * other >= determined;
  if (!enough || other < std::min(fit.joints(), 2)) return {};
  return {fmt::format("the torques are another quantity or unit, such as a current, or a gear ratio is "
                      "missing: they are {} times the torques that this robot needs for its motion",
                      fmt::join(ratios, ", ")),
          "write unit or scale (torque of one logged unit) of each tau into [log.columns]", true};
}

LogMismatch other_velocity(const Fit& fit) {
  std::vector<std::string> factors;
  for (int j = 0; j < fit.joints(); ++j)
    if (fit.is_determined(j) && fit.velocity_factor[j] != 1.0)
      factors.push_back(
          fmt::format("dq{0} is {1:.4g} times the derivative of q{0}", j + 1, fit.velocity_factor[j]));
  if (factors.empty()) return {};
  return {fmt::format("position, velocity and time are inconsistent: {}", fmt::join(factors, ", ")),
          "write their units into [log.columns], or correct the clock of the log"};
}

LogMismatch other_robot(const Beginning& beginning) {
  std::vector<int> far;
  const int joints = static_cast<int>(beginning.ever.size());
  for (int j = 0; j < joints; ++j)
    if (beginning.is_determined(j) && best_misfit(beginning.ever[j]) > kNeverNear) far.push_back(j + 1);
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
  if (!beginning.fit.has_motion()) return {};
  Best best = clearly_better_than(beginning);
  const double ratio = clock_ratio(beginning.rows, sample_period_s);
  try_interpretations(beginning, robot, clock_interpretations(ratio, sample_period_s), false, best);
  return best.doubt;
}

LogMismatch check_interpretation(LogSource& log, const KnownRobot& robot) {
  log.rewind();
  const Beginning beginning = find_beginning(log, robot, false);
  log.rewind();
  if (!beginning.fit.has_motion()) return {};
  if (beginning.fitted || score_of(beginning.fit).worst < kReadingFits)
    return other_torque(beginning.fit, true);
  Best best = clearly_better_than(beginning);
  try_interpretations(beginning, robot, common_interpretations(robot.chain()), false, best);
  try_interpretations(beginning, robot, column_interpretations(robot.chain()), false, best);
  if (best.doubt.is_empty())
    try_interpretations(beginning, robot, delay_interpretations(beginning.rows), true, best);
  for (const LogMismatch& doubt :
       {best.doubt, other_torque(beginning.fit, false), other_velocity(beginning.fit)})
    if (!doubt.is_empty()) return doubt;
  return other_robot(beginning);
}

}  // namespace faultline
