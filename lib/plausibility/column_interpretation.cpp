// SPDX-License-Identifier: MIT
#include "lib/plausibility/column_interpretation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <utility>

namespace faultline {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0, kMilli = 1e-3;  // rad in a degree; m in mm, s in ms

void scale(std::vector<double>& values, double by) {
  for (double& v : values) v *= by;
}

void scale_velocity(Log& log, int j, double by) {
  if (!log.dq.empty()) scale(log.dq[j], by);
}

void scale_motion(Log& log, int j, double by) {
  scale(log.q[j], by);
  scale_velocity(log, j, by);
}

void swap_motion(Log& log, int j, int k) {
  std::swap(log.q[j], log.q[k]);
  if (!log.dq.empty()) std::swap(log.dq[j], log.dq[k]);
}

void add_units(const Chain& chain, std::vector<ColumnInterpretation>& out) {
  const int n = chain.joints();
  const auto is_revolute = [&chain](int j) { return chain.geometry[j].kind == AxisKind::revolute; };
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
                   fmt::format("unit = \"{}/s\" for dq{}", unit, j + 1),
                   [j, by](Log& log) { scale_velocity(log, j, by); }});
  }
}

/// Adds one torque in thousandths or thousands of its unit; for all of them only the masses would differ.
void add_torque_units(const Chain& chain, std::vector<ColumnInterpretation>& out) {
  for (int j = 0; j < chain.joints(); ++j)
    for (const double by : {1e-3, 1e3})
      out.push_back(
          {fmt::format("tau{} is {} than the other torques", j + 1,
                       by < 1.0 ? "in a unit a thousand times smaller" : "in a unit a thousand times larger"),
           fmt::format("scale = {:g} for tau{}", by, j + 1), [j, by](Log& log) { scale(log.tau[j], by); }});
}

void add_signs(const Chain& chain, std::vector<ColumnInterpretation>& out) {
  for (int j = 0; j < chain.joints(); ++j) {
    out.push_back({fmt::format("tau{} has the opposite sign", j + 1),
                   fmt::format("sign = -1 for tau{}", j + 1), [j](Log& log) { scale(log.tau[j], -1.0); }});
    out.push_back({fmt::format("q{0} and dq{0} have the opposite sign", j + 1),
                   fmt::format("sign = -1 for q{0} and dq{0}", j + 1),
                   [j](Log& log) { scale_motion(log, j, -1.0); }});
    out.push_back({fmt::format("dq{} has the opposite sign", j + 1), fmt::format("sign = -1 for dq{}", j + 1),
                   [j](Log& log) { scale_velocity(log, j, -1.0); }});
  }
}

void add_swaps(const Chain& chain, std::vector<ColumnInterpretation>& out) {
  for (int j = 0; j < chain.joints(); ++j)
    for (int k = j + 1; k < chain.joints(); ++k) {
      out.push_back({fmt::format("tau{} and tau{} are swapped", j + 1, k + 1),
                     fmt::format("the other column for tau{} and tau{}", j + 1, k + 1),
                     [j, k](Log& log) { std::swap(log.tau[j], log.tau[k]); }});
      out.push_back({fmt::format("joints {} and {} are swapped in q and dq", j + 1, k + 1),
                     fmt::format("the other columns for q{0}, dq{0} and q{1}, dq{1}", j + 1, k + 1),
                     [j, k](Log& log) { swap_motion(log, j, k); }});
    }
}

/// Whether the chain has an axis of that kind.
bool has_axis(const Chain& chain, AxisKind kind) {
  return std::any_of(chain.geometry.begin(), chain.geometry.end(),
                     [kind](const JointGeometry& joint) { return joint.kind == kind; });
}

void add_common_units(const Chain& chain, std::vector<ColumnInterpretation>& out) {
  const auto on_axes = [&chain](AxisKind kind, double by, bool positions) {
    std::vector<int> joints;
    for (int j = 0; j < chain.joints(); ++j)
      if (chain.geometry[j].kind == kind) joints.push_back(j);
    return [joints, by, positions](Log& log) {
      for (const int j : joints) positions ? scale_motion(log, j, by) : scale_velocity(log, j, by);
    };
  };
  if (has_axis(chain, AxisKind::prismatic))
    out.push_back({"the sliding axes are in mm",
                   "unit = \"mm\" for q and \"mm/s\" for dq of the sliding axes",
                   on_axes(AxisKind::prismatic, kMilli, true)});
  if (has_axis(chain, AxisKind::revolute))
    out.push_back({"the velocities of the turning axes are in deg/s",
                   "unit = \"deg/s\" for dq of the revolute joints",
                   on_axes(AxisKind::revolute, kDegree, false)});
  for (const double by : {kMilli, 1.0 / kMilli})
    out.push_back({by < 1.0 ? "all torques are 1000 times too large (mN m)"
                            : "all torques are 1000 times too small (kN m)",
                   fmt::format("scale = {:g} for every tau", by), [by](Log& log) {
                     for (std::vector<double>& tau : log.tau) scale(tau, by);
                   }});
}

/// Adds joints with the opposite direction of counting, which differs from a wrong sign of one column.
void add_reversed_joints(const Chain& chain, std::vector<ColumnInterpretation>& out) {
  for (int j = 0; j < chain.joints(); ++j)
    out.push_back({fmt::format("joint {0} counts in the opposite direction (q{0}, dq{0} and tau{0})", j + 1),
                   fmt::format("sign = -1 for q{0}, dq{0} and tau{0}", j + 1), [j](Log& log) {
                     scale_motion(log, j, -1.0);
                     scale(log.tau[j], -1.0);
                   }});
}

void add_swapped_joints(const Chain& chain, std::vector<ColumnInterpretation>& out) {
  for (int j = 0; j < chain.joints(); ++j)
    for (int k = j + 1; k < chain.joints(); ++k)
      out.push_back(
          {fmt::format("joints {} and {} are swapped", j + 1, k + 1),
           fmt::format("the columns of joint {1} for q{0}, dq{0} and tau{0}, and those of joint {0} "
                       "for joint {1}",
                       j + 1, k + 1),
           [j, k](Log& log) {
             swap_motion(log, j, k);
             std::swap(log.tau[j], log.tau[k]);
           }});
}

std::vector<ColumnInterpretation> with_cures_into_columns(std::vector<ColumnInterpretation> readings) {
  for (ColumnInterpretation& reading : readings) {
    reading.cure = fmt::format("write {} into [log.columns]", reading.cure);
    reading.is_entry_of_columns = true;
  }
  return readings;
}

}  // namespace

std::vector<ColumnInterpretation> column_interpretations(const Chain& chain) {
  std::vector<ColumnInterpretation> readings;
  add_units(chain, readings);
  add_torque_units(chain, readings);
  add_signs(chain, readings);
  add_swaps(chain, readings);
  return with_cures_into_columns(std::move(readings));
}

std::vector<ColumnInterpretation> common_interpretations(const Chain& chain) {
  std::vector<ColumnInterpretation> readings;
  add_common_units(chain, readings);
  add_swapped_joints(chain, readings);
  add_reversed_joints(chain, readings);
  return with_cures_into_columns(std::move(readings));
}

std::vector<ColumnInterpretation> gravity_interpretations(const Chain& chain) {
  constexpr double kG = 9.81, kApart = 1.0;  // m/s^2
  std::vector<Eigen::Vector3d> tried{Eigen::Vector3d::Zero()};
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) tried.push_back(sign * kG * Eigen::Vector3d::Unit(axis));
  std::vector<ColumnInterpretation> readings;
  for (const Eigen::Vector3d& gravity : tried) {
    if ((gravity - chain.gravity).norm() < kApart) continue;
    const std::string text = fmt::format("[{:g}, {:g}, {:g}]", gravity[0], gravity[1], gravity[2]);
    readings.push_back({fmt::format("gravity is {}", text),
                        fmt::format("write gravity = {} into the robot file", text), [](Log&) {},
                        [gravity](Chain& other) { other.gravity = gravity; }});
  }
  return readings;
}

}  // namespace faultline
