// SPDX-License-Identifier: MIT
#include "lib/plausibility/column_interpretation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>
#include <utility>

namespace faultline {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0, kMilli = 1e-3;  // rad in a degree; m in mm, s in ms
constexpr double kOtherClock = 1.3;  // ratio of two sample periods from which on their clocks differ

using Interpretations = std::vector<ColumnInterpretation>;

void scale(std::vector<double>& values, double by) {
  for (double& v : values) v *= by;
}

void scale_position(Log& log, int j, double by) { scale(log.q[j], by); }

void scale_velocity(Log& log, int j, double by) {
  if (!log.dq.empty()) scale(log.dq[j], by);
}

void scale_motion(Log& log, int j, double by) {
  scale_position(log, j, by);
  scale_velocity(log, j, by);
}

void scale_torque(Log& log, int j, double by) { scale(log.tau[j], by); }

void scale_joint(Log& log, int j, double by) {
  scale_motion(log, j, by);
  scale_torque(log, j, by);
}

void swap_motion(Log& log, int j, int k) {
  std::swap(log.q[j], log.q[k]);
  if (!log.dq.empty()) std::swap(log.dq[j], log.dq[k]);
}

/// Returns an interpretation that is applied by `change` with the factor `by` to each of the joints.
ColumnInterpretation scaled(std::string what, const std::string& entry, const std::vector<int>& joints,
                            void (*change)(Log&, int, double), double by) {
  return {std::move(what), entry, [joints, change, by](Log& log) {
            for (const int j : joints) change(log, j, by);
          }};
}

std::vector<int> joints_of_kind(const Chain& chain, AxisKind kind) {
  std::vector<int> joints;
  for (int j = 0; j < chain.joints(); ++j)
    if (chain.geometry[j].kind == kind) joints.push_back(j);
  return joints;
}

void add_units(const Chain& chain, Interpretations& out) {
  out.push_back(scaled("the angles are in degrees",
                       "unit = \"deg\" for q and \"deg/s\" for dq of the revolute joints",
                       joints_of_kind(chain, AxisKind::revolute), scale_motion, kDegree));
  out.push_back(
      {"the time is in milliseconds", "unit = \"ms\" for t", [](Log& log) { scale(log.time, kMilli); }});
  for (int j = 0; j < chain.joints(); ++j) {
    const bool turns = chain.geometry[j].kind == AxisKind::revolute;
    const double by = turns ? kDegree : kMilli;
    const char* const unit = turns ? "deg" : "mm";
    out.push_back(scaled(fmt::format("q{0} and dq{0} are in {1} and {1}/s", Joint::at(j), unit),
                         fmt::format("unit = \"{1}\" for q{0} and \"{1}/s\" for dq{0}", Joint::at(j), unit),
                         {j}, scale_motion, by));
    out.push_back(scaled(fmt::format("q{} is in {}", Joint::at(j), unit),
                         fmt::format("unit = \"{}\" for q{}", unit, Joint::at(j)), {j}, scale_position, by));
    out.push_back(scaled(fmt::format("dq{} is in {}/s", Joint::at(j), unit),
                         fmt::format("unit = \"{}/s\" for dq{}", unit, Joint::at(j)), {j}, scale_velocity,
                         by));
  }
}

/// Adds one torque in thousandths or thousands of its unit; for all of them only the masses would differ.
void add_torque_units(const Chain& chain, Interpretations& out) {
  for (int j = 0; j < chain.joints(); ++j)
    for (const double by : {1e-3, 1e3}) {
      out.push_back(scaled(
          fmt::format("tau{} is {} than the other torques", Joint::at(j),
                      by < 1.0 ? "in a unit a thousand times smaller" : "in a unit a thousand times larger"),
          fmt::format("scale = {:g} for tau{}", by, Joint::at(j)), {j}, scale_torque, by));
      out.back().is_other_torque_unit = true;
    }
}

void add_signs(const Chain& chain, Interpretations& out) {
  std::vector<int> all(static_cast<std::size_t>(chain.joints()));
  std::iota(all.begin(), all.end(), 0);
  if (all.size() > 1)
    out.push_back(
        scaled("all torques have the opposite sign", "sign = -1 for each tau", all, scale_torque, -1.0));
  for (int j = 0; j < chain.joints(); ++j) {
    out.push_back(scaled(fmt::format("tau{} has the opposite sign", Joint::at(j)),
                         fmt::format("sign = -1 for tau{}", Joint::at(j)), {j}, scale_torque, -1.0));
    out.push_back(scaled(fmt::format("q{0} and dq{0} have the opposite sign", Joint::at(j)),
                         fmt::format("sign = -1 for q{0} and dq{0}", Joint::at(j)), {j}, scale_motion, -1.0));
    out.push_back(scaled(fmt::format("dq{} has the opposite sign", Joint::at(j)),
                         fmt::format("sign = -1 for dq{}", Joint::at(j)), {j}, scale_velocity, -1.0));
  }
}

void add_swaps(const Chain& chain, Interpretations& out) {
  for (int j = 0; j < chain.joints(); ++j)
    for (int k = j + 1; k < chain.joints(); ++k) {
      out.push_back({fmt::format("tau{} and tau{} are swapped", Joint::at(j), Joint::at(k)),
                     fmt::format("the other column for tau{} and tau{}", Joint::at(j), Joint::at(k)),
                     [j, k](Log& log) { std::swap(log.tau[j], log.tau[k]); }});
      out.push_back(
          {fmt::format("joints {} and {} are swapped in q and dq", Joint::at(j), Joint::at(k)),
           fmt::format("the other columns for q{0}, dq{0} and q{1}, dq{1}", Joint::at(j), Joint::at(k)),
           [j, k](Log& log) { swap_motion(log, j, k); }});
    }
}

void add_common_units(const Chain& chain, Interpretations& out) {
  const std::vector<int> turning = joints_of_kind(chain, AxisKind::revolute),
                         sliding = joints_of_kind(chain, AxisKind::prismatic);
  if (!sliding.empty())
    out.push_back(scaled("the sliding axes are in mm",
                         "unit = \"mm\" for q and \"mm/s\" for dq of the sliding axes", sliding, scale_motion,
                         kMilli));
  if (!turning.empty())
    out.push_back(scaled("the velocities of the turning axes are in deg/s",
                         "unit = \"deg/s\" for dq of the revolute joints", turning, scale_velocity, kDegree));
  for (const double by : {kMilli, 1.0 / kMilli})
    out.push_back({by < 1.0 ? "all torques are 1000 times too large (mN m)"
                            : "all torques are 1000 times too small (kN m)",
                   fmt::format("scale = {:g} for every tau", by), [by](Log& log) {
                     for (std::vector<double>& tau : log.tau) scale(tau, by);
                   }});
}

void add_swapped_joints(const Chain& chain, Interpretations& out) {
  for (int j = 0; j < chain.joints(); ++j)
    for (int k = j + 1; k < chain.joints(); ++k)
      out.push_back(
          {fmt::format("joints {} and {} are swapped", Joint::at(j), Joint::at(k)),
           fmt::format("the columns of joint {1} for q{0}, dq{0} and tau{0}, and those of joint {0} "
                       "for joint {1}",
                       Joint::at(j), Joint::at(k)),
           [j, k](Log& log) {
             swap_motion(log, j, k);
             std::swap(log.tau[j], log.tau[k]);
           }});
}

/// Adds joints with the opposite direction of counting, which differs from a wrong sign of one column.
void add_reversed_joints(const Chain& chain, Interpretations& out) {
  for (int j = 0; j < chain.joints(); ++j)
    out.push_back(scaled(
        fmt::format("joint {0} counts in the opposite direction (q{0}, dq{0} and tau{0})", Joint::at(j)),
        fmt::format("sign = -1 for q{0}, dq{0} and tau{0}", Joint::at(j)), {j}, scale_joint, -1.0));
}

/// Returns the interpretations, whose cures are entries of [log.columns] so far, with whole instructions.
Interpretations with_cures_into_columns(Interpretations all) {
  for (ColumnInterpretation& one : all) {
    one.cure = fmt::format("write {} into [log.columns]", one.cure);
    one.is_entry_of_columns = true;
  }
  return all;
}

double period_of(const Log& rows) { return (rows.time.back() - rows.time.front()) / (rows.rows() - 1); }

/// Returns how far a joint moves in the log in which it moves farthest.
double range_of(const std::vector<Log>& logs, std::size_t joint) {
  double widest = 0.0;
  for (const Log& log : logs) {
    double low = INFINITY, high = -INFINITY;
    for (const double q : log.q[joint]) low = std::fmin(low, q), high = std::fmax(high, q);
    widest = std::max(widest, high - low);
  }
  return widest;
}

}  // namespace

std::vector<ColumnInterpretation> column_interpretations(const Chain& chain) {
  Interpretations all;
  add_units(chain, all);
  add_torque_units(chain, all);
  add_signs(chain, all);
  add_swaps(chain, all);
  return with_cures_into_columns(std::move(all));
}

std::vector<ColumnInterpretation> interpretations_by_known_robot(const Chain& chain) {
  Interpretations all;
  add_common_units(chain, all);
  add_swapped_joints(chain, all);
  add_reversed_joints(chain, all);
  all = with_cures_into_columns(std::move(all));
  std::ranges::move(column_interpretations(chain), std::back_inserter(all));
  return all;
}

std::vector<ColumnInterpretation> gravity_interpretations(const Chain& chain) {
  constexpr double kG = 9.81, kApart = 1.0;  // m/s^2
  std::vector<Eigen::Vector3d> tried{Eigen::Vector3d::Zero()};
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) tried.push_back(sign * kG * Eigen::Vector3d::Unit(axis));
  Interpretations all;
  for (const Eigen::Vector3d& gravity : tried) {
    if ((gravity - chain.gravity).norm() < kApart) continue;
    const std::string text = fmt::format("[{:g}, {:g}, {:g}]", gravity[0], gravity[1], gravity[2]);
    all.push_back({fmt::format("gravity is {}", text),
                   fmt::format("write gravity = {} into the robot file", text), [](Log&) {},
                   [gravity](Chain& other) { other.gravity = gravity; }});
  }
  return all;
}

std::vector<ColumnInterpretation> clock_interpretations(const Log& rows, double period_s) {
  const double ratio = rows.rows() < 2 ? 1.0 : period_of(rows) / period_s;
  if (ratio <= kOtherClock && ratio >= 1.0 / kOtherClock) return {};
  constexpr double kNear = 0.05;  // relative error of a ratio that counts as ms
  const auto apply = [ratio](Log& log) {
    for (double& t : log.time) t /= ratio;
  };
  if (std::abs(ratio * kMilli - 1.0) < kNear)
    return with_cures_into_columns({{"the time is in milliseconds", "unit = \"ms\" for t", apply}});
  return {{fmt::format("its time runs {:.4g} times too {}: the motion fits a row every {:.4g} s",
                       std::max(ratio, 1.0 / ratio), ratio > 1.0 ? "fast" : "slow", period_s),
           fmt::format("write scale = {:.6g} for t into [log.columns], or correct the clock of the log",
                       1.0 / ratio),
           apply}};
}

std::vector<ColumnInterpretation> delay_interpretations(const Log& rows) {
  // Rows: the first delay tried; the next is a third longer each time, up to a quarter of the log.
  constexpr int kFirstStep = 2, kFiner = 3, kShortest = 4;
  const double period = period_of(rows);
  Interpretations all;
  for (int step = kFirstStep; kShortest * step < rows.rows(); step += std::max(1, step / kFiner))
    for (const int shift : {step, -step})
      all.push_back({fmt::format("the torques are logged about {:.2g} s too {}", std::abs(shift) * period,
                                 shift > 0 ? "late" : "early"),
                     "record torque and motion with one clock, or shift the torque before the diagnosis",
                     [shift](Log& log) {
                       for (std::vector<double>& tau : log.tau) {
                         const std::vector<double> logged = tau;
                         const int last = static_cast<int>(tau.size()) - 1;
                         for (int k = 0; k <= last; ++k) tau[k] = logged[std::clamp(k + shift, 0, last)];
                       }
                     }});
  return all;
}

const ColumnInterpretation* best_interpretation(std::span<const ColumnInterpretation> interpretations,
                                                const std::vector<Log>& logs,
                                                const std::vector<double>& least_motion, double limit,
                                                const InterpretationScore& score) {
  const ColumnInterpretation* best = nullptr;
  for (const ColumnInterpretation& one : interpretations) {
    std::vector<Log> changed = logs;
    for (Log& log : changed) one.apply(log);
    bool hides_motion = false;
    for (std::size_t j = 0; j < least_motion.size(); ++j)
      hides_motion =
          hides_motion || (range_of(changed, j) < least_motion[j] && range_of(logs, j) >= least_motion[j]);
    if (hides_motion) continue;
    const std::optional<double> now = score(one, changed);
    if (!now || *now >= limit) continue;
    best = &one;
    limit = *now;
  }
  return best;
}

}  // namespace faultline
