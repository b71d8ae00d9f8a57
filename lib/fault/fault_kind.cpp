// SPDX-License-Identifier: MIT
#include "lib/fault/fault_kind.hpp"

#include "lib/core/error.hpp"

namespace faultline {
namespace {

constexpr std::array<const char*, kFaultKinds> kNames = {
    "none",         "free_swinging",     "locked",         "torque_loss", "sensor_bias", "stuck_encoder",
    "sensor_drift", "friction_increase", "payload_change", "collision",   "unknown"};

}  // namespace

const char* to_string(FaultKind kind) { return kNames[static_cast<std::size_t>(kind)]; }

FaultKind fault_kind_from(const std::string& name) {
  std::string known;
  for (int i = 0; i < kFaultKinds; ++i) {
    if (name == kNames[i]) return static_cast<FaultKind>(i);
    known += (i ? ", " : "") + std::string(kNames[i]);
  }
  throw Error(ErrorCode::usage, "fault", "\"" + name + "\" is no fault name; expected one of " + known);
}

}  // namespace faultline
