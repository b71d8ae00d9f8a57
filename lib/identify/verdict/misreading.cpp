// SPDX-License-Identifier: MIT
#include "lib/identify/verdict/misreading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "lib/core/error.hpp"
#include "lib/identify/feasible/feasible.hpp"
#include "lib/identify/gathered.hpp"
#include "lib/identify/wanted_parameters.hpp"
#include "lib/identify/weak_form/weak_form.hpp"
#include "lib/log/memory_source.hpp"

namespace faultline {
namespace {

constexpr int kRows = 3000;         // of the beginning of a log
constexpr std::size_t kLogs = 2;    // looked at
constexpr double kWindow_s = 0.16;  // long enough for any noise
constexpr int kWindows = 2000;
constexpr double kRight = 0.8;         // share of each joint's torque that the right reading must explain
constexpr double kSurelyRight = 0.95;  // the same where what is read now fits no robot that can be
constexpr double kClearlyLess = 0.5;   // of what the reading as it is leaves, by joint in the mean

struct Reading {
  std::string what, cure;
  std::function<void(Log&)> apply;
  std::function<void(Robot&)> robot = {};  ///< what the robot file would say instead; none: as it is
};

void scale(std::vector<double>& values, double by) {
  for (double& v : values) v *= by;
}

void scale_motion(Log& log, int j, double by) {
  scale(log.q[j], by);
  if (!log.dq.empty()) scale(log.dq[j], by);
}

void add_units(const Robot& robot, std::vector<Reading>& out) {
  constexpr double kDegree = std::numbers::pi / 180.0, kMilli = 1e-3;
  const int n = robot.joints();
  const auto is_revolute = [&robot](int j) { return robot.chain.geometry[j].kind == AxisKind::revolute; };
  out.push_back({"the angles are in degrees",
                 "unit = \"deg\" for q and \"deg/s\" for dq of the revolute joints",
                 [n, is_revolute](Log& log) {
                   for (int j = 0; j < n; ++j)
                     if (is_revolute(j)) scale_motion(log, j, kDegree);
                 }});
  out.push_back(
      {"the time is in milliseconds", "unit = \"ms\" for t", [](Log& log) { scale(log.time, kMilli); }});
  for (int j = 0; j < n; ++j) {
    const double by = is_revolute(j) ? kDegree : kMilli;
    const char* const unit = is_revolute(j) ? "deg" : "mm";
    out.push_back({fmt::format("q{0} and dq{0} are in {1} and {1}/s", j + 1, unit),
                   fmt::format("unit = \"{1}\" for q{0} and \"{1}/s\" for dq{0}", j + 1, unit),
                   [j, by](Log& log) { scale_motion(log, j, by); }});
    out.push_back({fmt::format("q{} is in {}", j + 1, unit),
                   fmt::format("unit = \"{}\" for q{}", unit, j + 1),
                   [j, by](Log& log) { scale(log.q[j], by); }});
    out.push_back({fmt::format("dq{} is in {}/s", j + 1, unit),
                   fmt::format("unit = \"{}/s\" for dq{}", unit, j + 1), [j, by](Log& log) {
                     if (!log.dq.empty()) scale(log.dq[j], by);
                   }});
  }
}

/// One torque in thousandths or thousands of its unit; all of them together show in the masses alone.
void add_torque_units(const Robot& robot, std::vector<Reading>& out) {
  for (int j = 0; j < robot.joints(); ++j)
    for (const double by : {1e-3, 1e3})
      out.push_back(
          {fmt::format("tau{} is {} than the other torques", j + 1,
                       by < 1.0 ? "in a unit a thousand times smaller" : "in a unit a thousand times larger"),
           fmt::format("scale = {:g} for tau{}", by, j + 1), [j, by](Log& log) { scale(log.tau[j], by); }});
}

void add_signs(const Robot& robot, std::vector<Reading>& out) {
  for (int j = 0; j < robot.joints(); ++j) {
    out.push_back({fmt::format("tau{} has the other sign", j + 1), fmt::format("sign = -1 for tau{}", j + 1),
                   [j](Log& log) { scale(log.tau[j], -1.0); }});
    out.push_back({fmt::format("q{0} and dq{0} have the other sign", j + 1),
                   fmt::format("sign = -1 for q{0} and dq{0}", j + 1),
                   [j](Log& log) { scale_motion(log, j, -1.0); }});
    out.push_back({fmt::format("dq{} has the other sign", j + 1), fmt::format("sign = -1 for dq{}", j + 1),
                   [j](Log& log) {
                     if (!log.dq.empty()) scale(log.dq[j], -1.0);
                   }});
  }
}

void add_swaps(const Robot& robot, std::vector<Reading>& out) {
  for (int j = 0; j < robot.joints(); ++j)
    for (int k = j + 1; k < robot.joints(); ++k) {
      out.push_back({fmt::format("tau{} and tau{} are swapped", j + 1, k + 1),
                     fmt::format("the other column for tau{} and tau{}", j + 1, k + 1),
                     [j, k](Log& log) { std::swap(log.tau[j], log.tau[k]); }});
      out.push_back({fmt::format("joints {} and {} are swapped in q and dq", j + 1, k + 1),
                     fmt::format("the other columns for q{0}, dq{0} and q{1}, dq{1}", j + 1, k + 1),
                     [j, k](Log& log) {
                       std::swap(log.q[j], log.q[k]);
                       if (!log.dq.empty()) std::swap(log.dq[j], log.dq[k]);
                     }});
    }
}

/// Gravity along another axis, or none: an arm on its side, hanging, or of horizontal axes.
void add_gravity(const Robot& robot, std::vector<Reading>& out) {
  constexpr double kG = 9.81, kApart = 1.0;  // m/s^2
  std::vector<Eigen::Vector3d> tried{Eigen::Vector3d::Zero()};
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) tried.push_back(sign * kG * Eigen::Vector3d::Unit(axis));
  for (const Eigen::Vector3d& gravity : tried) {
    if ((gravity - robot.chain.gravity).norm() < kApart) continue;
    const std::string text = fmt::format("[{:g}, {:g}, {:g}]", gravity[0], gravity[1], gravity[2]);
    out.push_back({fmt::format("gravity is {}", text), fmt::format("gravity = {}", text), [](Log&) {},
                   [gravity](Robot& other) { other.chain.gravity = gravity; }});
  }
}

/// Whether a reading makes of a motion one too small to be meant.
bool shrinks_motion(const std::vector<Log>& before, const std::vector<Log>& after, const Robot& robot) {
  constexpr double kLeastTurn = 0.03, kLeastWay_m = 0.003;
  const auto range = [](const std::vector<Log>& logs, int j) {
    double widest = 0.0;
    for (const Log& log : logs) {
      const auto [low, high] = std::minmax_element(log.q[j].begin(), log.q[j].end());
      if (low != log.q[j].end()) widest = std::max(widest, *high - *low);
    }
    return widest;
  };
  for (int j = 0; j < robot.joints(); ++j) {
    const double least = robot.chain.geometry[j].kind == AxisKind::revolute ? kLeastTurn : kLeastWay_m;
    const double now = range(after, j);
    if (now < least && now < 0.5 * range(before, j)) return true;
  }
  return false;
}

/// How well a reading of the logs is explained.
struct Explained {
  std::vector<double> r2;  ///< by joint
  bool feasible = false;

  double worst() const { return r2.empty() ? -1.0 : *std::min_element(r2.begin(), r2.end()); }
  /// Mean logarithm of what is left.
  double left() const {
    double sum = 0.0;
    for (const double r : r2) sum += std::log(std::max(1.0 - r, 1e-9));
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
    Identification id;
    id.space = parameter_space(robot);
    Gathered gathered = gather(pointers, kWindow_s, kWindows, {}, id);
    const int n = robot.joints();
    const std::vector<int> still = still_joints(gathered.measurements, id.space);
    gathered.leave_out_joints(still);
    const WantedParameters wanted = wanted_parameters(id.space, robot, still, false);
    std::vector<bool> free = wanted.asked;
    for (std::size_t p = 0; p < free.size(); ++p) free[p] = free[p] && !wanted.optional[p];
    const WeakChoice choice{std::vector<int>(n, 0), std::vector<int>(n, 0), std::vector<int>(n, 1),
                            std::vector<int>(n, 0)};
    const WeakFit fit = fit_weak_form(assemble(gathered.windows, choice), id.space,
                                      parameters_of(id.space, robot.chain, 0.5), free);
    const Measurements& m = gathered.measurements;
    for (int j = 0; j < n; ++j)
      if (!gathered.windows.still[j]) out.r2.push_back(fit.r2[j]);
    out.feasible = infeasibility(id.space, fit.parameters, fit.covariance, m.q_low(), m.q_high()).empty();
  } catch (const Error&) {
    return {};  // read like this, the logs give nothing to fit
  }
  return out;
}

}  // namespace

Misreading find_misreading(std::span<LogSource* const> logs, const Robot& robot) {
  std::vector<Log> beginnings;
  for (std::size_t i = 0; i < std::min(logs.size(), kLogs); ++i) {
    logs[i]->rewind();
    Log taken;
    for (Log segment; taken.rows() < kRows && logs[i]->next(segment);)
      append(taken, slice(segment, 0, std::min(segment.rows(), kRows - taken.rows())));
    beginnings.push_back(std::move(taken));
  }
  std::vector<Reading> readings;
  add_units(robot, readings);
  add_torque_units(robot, readings);
  add_signs(robot, readings);
  add_swaps(robot, readings);
  for (Reading& reading : readings) reading.cure = "write " + reading.cure + " into [log.columns]";
  const std::size_t of_columns = readings.size();
  add_gravity(robot, readings);
  for (std::size_t i = of_columns; i < readings.size(); ++i)
    readings[i].cure = "write " + readings[i].cure + " into the robot file";
  const Explained now = explain(beginnings, robot);
  Misreading best;
  best.r2_before = now.worst();
  double least = now.left() + std::log(kClearlyLess);
  for (const Reading& reading : readings) {
    if (reading.robot && !best.what.empty()) break;  // columns first, they are wrong more often
    std::vector<Log> read = beginnings;
    for (Log& log : read) reading.apply(log);
    if (shrinks_motion(beginnings, read, robot)) continue;
    Robot other = robot;
    if (reading.robot) reading.robot(other);
    const Explained then = explain(read, other);
    if (!then.feasible || then.worst() < (now.feasible ? kRight : kSurelyRight)) continue;
    if ((now.feasible || !best.what.empty()) && then.left() >= least) continue;
    least = then.left();
    best = {reading.what, reading.cure, now.worst(), then.worst()};
  }
  return best;
}

}  // namespace faultline
