// SPDX-License-Identifier: MIT
#include "lib/simulate/fault_event.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lib/core/error.hpp"
#include "lib/robot/axis_units.hpp"

namespace faultline {
namespace {

[[noreturn]] void bad(const char* key, const std::string& message) {
  throw Error(ErrorCode::usage, std::string("fault.") + key, message);
}

void check_size(const Robot& robot, const FaultEvent& fault) {
  if (!std::isfinite(fault.size) || !std::isfinite(fault.viscous)) bad("size", "expected a finite number");
  if (fault.kind == FaultKind::torque_loss && !(fault.size > 0.0 && fault.size <= 1.0))
    bad("size",
        fmt::format("expected the share of torque lost, above 0 and at most 1, found {}", fault.size));
  if (fault.kind == FaultKind::friction_increase &&
      (fault.size < 0.0 || fault.viscous < 0.0 || fault.size + fault.viscous == 0.0))
    bad("size", "expected added Coulomb (size) or viscous friction, not negative and not both 0");
  const bool sized = fault.kind == FaultKind::sensor_bias || fault.kind == FaultKind::sensor_drift ||
                     fault.kind == FaultKind::payload_change || fault.kind == FaultKind::collision;
  if (sized && fault.size == 0.0)
    bad("size", fmt::format("a {} needs a size other than 0", to_string(fault.kind)));
  if (fault.kind == FaultKind::payload_change && robot.chain.links.back().mass + fault.size <= 0.0)
    bad("size",
        fmt::format("takes {} kg from a last link of {} kg", -fault.size, robot.chain.links.back().mass));
}

}  // namespace

void check_fault(const Robot& robot, const FaultEvent& fault) {
  if (fault.kind == FaultKind::none) return;
  if (fault.kind == FaultKind::unknown) bad("kind", "\"unknown\" cannot be simulated; name a kind");
  if (fault.kind != FaultKind::payload_change && (fault.joint < 1 || fault.joint > robot.joints()))
    bad("joint", fmt::format("expected 1 to {}, found {}", robot.joints(), fault.joint));
  if (!(fault.onset_s >= 0.0 && std::isfinite(fault.onset_s)))
    bad("onset_s", fmt::format("expected a time that is not negative, found {}", fault.onset_s));
  if (!(fault.end_s > fault.onset_s))
    bad("end_s", fmt::format("expected a time after onset_s = {}, found {}", fault.onset_s, fault.end_s));
  if (fault.kind == FaultKind::collision && !std::isfinite(fault.end_s))
    bad("end_s", "a collision is a pulse and needs an end_s (or a duration)");
  check_size(robot, fault);
}

std::string size_unit(const Robot& robot, const FaultEvent& fault) {
  if (fault.joint < 1 || fault.joint > robot.joints())
    return fault.kind == FaultKind::payload_change ? "kg" : "";
  const AxisKind axis = robot.chain.geometry[fault.joint - 1].kind;
  switch (fault.kind) {
    case FaultKind::torque_loss:
      return "1";
    case FaultKind::sensor_bias:
      return position_unit(axis);
    case FaultKind::sensor_drift:
      return velocity_unit(axis);
    case FaultKind::friction_increase:
    case FaultKind::collision:
      return torque_unit(axis);
    case FaultKind::payload_change:
      return "kg";
    default:
      return "";
  }
}

}  // namespace faultline
