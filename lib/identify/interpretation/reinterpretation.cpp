// SPDX-License-Identifier: MIT
#include "lib/identify/interpretation/reinterpretation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/error.hpp"
#include "lib/identify/feasible/feasible.hpp"
#include "lib/identify/gathered.hpp"
#include "lib/identify/parameter_space.hpp"
#include "lib/identify/weak_form/weak_form.hpp"
#include "lib/log/memory_source.hpp"
#include "lib/plausibility/column_interpretation.hpp"

namespace faultline {
namespace {

constexpr int kRows = 3000;                   // from the beginning of a log
constexpr std::size_t kLogs = 2;              // used
constexpr double kMisreadingWindow_s = 0.16;  // long enough to average any noise
constexpr int kMisreadingWindows = 2000;      // at most: every interpretation costs a fit of them
constexpr double kRight = 0.8;                // least R2 of each joint under a right interpretation
constexpr double kSurelyRight = 0.95;         // the same if the present interpretation is infeasible
constexpr double kClearlyLess = 0.5;          // of the present residual, in the mean over joints

/// Whether an interpretation shrinks the motion of a joint below a plausible one.
bool shrinks_motion(const std::vector<Log>& before, const std::vector<Log>& after, const Robot& robot) {
  constexpr double kLeastMove_rad = 0.03, kLeastMove_m = 0.003;  // range of a joint: less is no motion
  const auto range = [](const std::vector<Log>& logs, int j) {
    double widest = 0.0;
    for (const Log& log : logs) {
      const auto [low, high] = std::minmax_element(log.q[j].begin(), log.q[j].end());
      if (low != log.q[j].end()) widest = std::max(widest, *high - *low);
    }
    return widest;
  };
  for (int j = 0; j < robot.joints(); ++j) {
    const double least = robot.chain.geometry[j].kind == AxisKind::revolute ? kLeastMove_rad : kLeastMove_m;
    const double now = range(after, j);
    if (now < least && now < 0.5 * range(before, j)) return true;
  }
  return false;
}

/// How well the robot explains the logs under an interpretation.
struct Explained {
  std::vector<double> r2;  ///< by joint
  bool feasible = false;

  double worst() const { return r2.empty() ? -1.0 : *std::min_element(r2.begin(), r2.end()); }
  /// Returns the mean logarithm of the unexplained share.
  double left() const {
    double sum = 0.0;
    for (const double r : r2) sum += elementary::log(std::max(1.0 - r, 1e-9));
    return r2.empty() ? 1e9 : sum / static_cast<double>(r2.size());
  }
};

Explained explain(const std::vector<Log>& logs, const Robot& robot) {
  std::vector<MemorySource> sources;
  sources.reserve(logs.size());
  std::vector<LogSource*> pointers;
  for (const Log& log : logs) sources.emplace_back(log, "excerpt");
  for (MemorySource& source : sources) pointers.push_back(&source);
  Explained out;
  try {
    const ParameterSpace space = parameter_space(robot);
    const Gathered gathered = gather(pointers, space, kMisreadingWindow_s, kMisreadingWindows, {});
    const int n = robot.joints();
    const std::vector<int>& still = gathered.windows.still;
    const WantedParameters wanted = wanted_parameters(space, robot, still, false);
    std::vector<bool> free = wanted.asked;
    for (std::size_t p = 0; p < free.size(); ++p) free[p] = free[p] && !wanted.optional[p];
    const WeakChoice choice{std::vector<int>(n, 0), std::vector<int>(n, 0), std::vector<int>(n, 1),
                            std::vector<int>(n, 0)};
    const WeakFit fit = fit_weak_form(assemble(gathered.windows, choice), space,
                                      parameters_of(space, robot.chain, 0.5), free);
    const Measurements& m = gathered.measurements;
    for (int j = 0; j < n; ++j)
      if (!has_joint(still, j)) out.r2.push_back(fit.r2[j]);
    out.feasible = infeasibility(space, fit.parameters, fit.covariance, m.q_low(), m.q_high()).empty();
  } catch (const Error&) {
    return {};  // with this interpretation, the logs do not allow a fit
  }
  return out;
}

}  // namespace

Reinterpretation find_reinterpretation(std::span<LogSource* const> logs, const Robot& robot) {
  std::vector<Log> beginnings;
  for (std::size_t i = 0; i < std::min(logs.size(), kLogs); ++i) {
    logs[i]->rewind();
    Log taken;
    for (Log segment; taken.rows() < kRows && logs[i]->next(segment);)
      append(taken, slice(segment, 0, std::min(segment.rows(), kRows - taken.rows())));
    beginnings.push_back(std::move(taken));
  }
  std::vector<ColumnInterpretation> readings = column_interpretations(robot.chain);
  for (ColumnInterpretation& reading : gravity_interpretations(robot.chain))
    readings.push_back(std::move(reading));
  const Explained now = explain(beginnings, robot);
  Reinterpretation best;
  best.r2_before = now.worst();
  double least = now.left() + elementary::log(kClearlyLess);
  for (const ColumnInterpretation& reading : readings) {
    if (reading.of_robot && !best.what.empty()) break;  // columns first: errors in them are more frequent
    std::vector<Log> read = beginnings;
    for (Log& log : read) reading.apply(log);
    if (shrinks_motion(beginnings, read, robot)) continue;
    Robot other = robot;
    if (reading.of_robot) reading.of_robot(other.chain);
    const Explained then = explain(read, other);
    if (!then.feasible || then.worst() < (now.feasible ? kRight : kSurelyRight)) continue;
    if ((now.feasible || !best.what.empty()) && then.left() >= least) continue;
    least = then.left();
    best = {reading.what, reading.cure, now.worst(), then.worst()};
  }
  return best;
}

}  // namespace faultline
