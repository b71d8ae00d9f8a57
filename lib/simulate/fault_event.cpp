// SPDX-License-Identifier: MIT
#include "lib/simulate/fault_event.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lib/fault/fault_catalogue.hpp"
#include "lib/simulate/joint_list.hpp"

namespace faultline {
namespace {

void check_size(const Robot& robot, const SimulatedFault& fault) {
  if (!std::isfinite(fault.size) || !std::isfinite(fault.viscous))
    bad_value("fault.size", "expected a finite number");
  if (fault.kind == FaultKind::torque_loss && !(fault.size > 0.0 && fault.size <= 1.0))
    bad_value("fault.size",
              fmt::format("expected the share of torque lost, above 0 and at most 1, found {}", fault.size));
  if (fault.kind == FaultKind::friction_increase &&
      (fault.size < 0.0 || fault.viscous < 0.0 || fault.size + fault.viscous == 0.0))
    bad_value("fault.size", "expected added Coulomb (size) or viscous friction, not negative and not both 0");
  if (describe(fault.kind).size_count == 1 && fault.size == 0.0)
    bad_value("fault.size", fmt::format("a {} needs a size other than 0", to_string(fault.kind)));
  if (fault.kind != FaultKind::payload_change) return;
  const Joint link = fault.joint.is_none() ? Joint::at(robot.joints() - 1) : fault.joint;
  const double mass = robot.chain.links[static_cast<std::size_t>(link.index())].mass;
  if (mass + fault.size <= 0.0)
    bad_value("fault.size", fmt::format("removes {} kg from link {} of {} kg", -fault.size, link, mass));
}

}  // namespace

void check_fault(const Robot& robot, const SimulatedFault& fault) {
  if (fault.kind == FaultKind::none) return;
  if (fault.kind == FaultKind::unknown)
    bad_value("fault.kind", "\"unknown\" cannot be simulated; name a kind");
  const bool is_left_out = describe(fault.kind).place == FaultPlace::link && fault.joint == Joint();
  if (!is_left_out && (fault.joint.is_none() || fault.joint.index() >= robot.joints()))
    bad_value("fault.joint", fmt::format("expected 1 to {}, found {}", robot.joints(), fault.joint));
  if (!(fault.onset_s >= 0.0 && std::isfinite(fault.onset_s)))
    bad_value("fault.onset_s", fmt::format("expected a time that is not negative, found {}", fault.onset_s));
  if (!(fault.end_s > fault.onset_s))
    bad_value("fault.end_s",
              fmt::format("expected a time after onset_s = {}, found {}", fault.onset_s, fault.end_s));
  if (describe(fault.kind).passes && !std::isfinite(fault.end_s))
    bad_value("fault.end_s",
              fmt::format("a {} is a pulse and needs an end_s (or a duration)", to_string(fault.kind)));
  check_size(robot, fault);
}

MachineFault machine_fault(const SimulatedFault& fault) {
  switch (fault.kind) {
    case FaultKind::none:
    case FaultKind::unknown:
      return {};
    case FaultKind::free_swinging:
      return {.torque_gain = 0.0};
    case FaultKind::locked:
      return {.locks = true};
    case FaultKind::torque_loss:
      return {.torque_gain = 1.0 - fault.size};
    case FaultKind::sensor_bias:
      return {.reading_offset = fault.size};
    case FaultKind::stuck_encoder:
      return {.reading_sticks = true};
    case FaultKind::sensor_drift:
      return {.reading_drift_per_s = fault.size};
    case FaultKind::friction_increase:
      return {.coulomb = fault.size, .viscous = fault.viscous};
    case FaultKind::payload_change:
      return {.payload = fault.size};
    case FaultKind::collision:
      return {.external_torque = fault.size};
    case FaultKind::torque_sensor_error:
      return {.drive_offset = -fault.size};
  }
  return {};
}

std::string size_unit(const Robot& robot, const SimulatedFault& fault) {
  const std::span<const FaultSize> sizes = describe(fault.kind).sizes();
  if (sizes.empty()) return "";
  const bool at_joint = !fault.joint.is_none() && fault.joint.index() < robot.joints();
  if (!at_joint && describe(fault.kind).place != FaultPlace::link) return "";
  const bool turns = at_joint && robot.chain.geometry[fault.joint.index()].kind == AxisKind::revolute;
  return unit_of(sizes.back().measure, turns);
}

}  // namespace faultline
