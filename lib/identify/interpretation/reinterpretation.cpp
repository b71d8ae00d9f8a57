// SPDX-License-Identifier: MIT
#include "lib/identify/interpretation/reinterpretation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/error.hpp"
#include "lib/identify/feasible/feasible.hpp"
#include "lib/identify/gathered.hpp"
#include "lib/identify/parameter_space.hpp"
#include "lib/identify/weak_form/weak_form.hpp"
#include "lib/log/log_source.hpp"
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
constexpr double kLeastMotion_rad = 0.03, kLeastMotion_m = 0.003;  // range of a joint: less is no motion

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
    const std::vector<Joint>& still = gathered.windows.still;
    const WantedParameters wanted = wanted_parameters(space, robot, still, false);
    std::vector<bool> free = wanted.asked;
    for (std::size_t p = 0; p < free.size(); ++p) free[p] = free[p] && !wanted.optional[p];
    const WeakChoice choice{std::vector<int>(n, 0), std::vector<int>(n, 0), std::vector<int>(n, 1),
                            std::vector<int>(n, 0)};
    const WeakFit fit = fit_weak_form(assemble(gathered.windows, choice), space,
                                      parameters_of(space, robot.chain, 0.5), free);
    const Measurements& m = gathered.measurements;
    for (int j = 0; j < n; ++j)
      if (!has_joint(still, Joint::at(j))) out.r2.push_back(fit.r2[j]);
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
  std::vector<double> least_motion;
  for (const JointGeometry& joint : robot.chain.geometry)
    least_motion.push_back(joint.kind == AxisKind::revolute ? kLeastMotion_rad : kLeastMotion_m);
  const auto explained_by = [&](const ColumnInterpretation& one, const std::vector<Log>& as_interpreted) {
    Robot other = robot;
    if (one.of_robot) one.of_robot(other.chain);
    return explain(as_interpreted, other);
  };
  const Explained now = explain(beginnings, robot);
  const auto score = [&](const ColumnInterpretation& one,
                         const std::vector<Log>& as_interpreted) -> std::optional<double> {
    const Explained then = explained_by(one, as_interpreted);
    if (!then.feasible || then.worst() < (now.feasible ? kRight : kSurelyRight)) return std::nullopt;
    // A wrong sign shows in infeasible values alone; a wrong unit of one torque leaves a residual as well.
    if (one.is_other_torque_unit && then.left() > now.left() + elementary::log(kClearlyLess))
      return std::nullopt;
    return then.left();
  };
  const double limit = now.feasible ? now.left() + elementary::log(kClearlyLess) : INFINITY;
  // Columns first: errors in them are more frequent.
  for (const auto& interpretations :
       {column_interpretations(robot.chain), gravity_interpretations(robot.chain)})
    if (const auto* best = best_interpretation(interpretations, beginnings, least_motion, limit, score)) {
      for (Log& log : beginnings) best->apply(log);
      return {best->what, best->cure, now.worst(), explained_by(*best, beginnings).worst()};
    }
  return {};
}

}  // namespace faultline
