// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/core/joint.hpp"

namespace faultline {

/// A kind of fault, described in fault_catalogue.cpp in the same order.
enum class FaultKind {
  none,
  free_swinging,        ///< no torque reaches the joint
  locked,               ///< the joint does not move
  torque_loss,          ///< a share of the torque is lost
  sensor_bias,          ///< the position has a constant error
  stuck_encoder,        ///< position and velocity repeat the last code
  sensor_drift,         ///< the position error grows with time
  friction_increase,    ///< more viscous and Coulomb friction
  payload_change,       ///< mass added at, or taken from, the end of a link
  collision,            ///< a short external force
  torque_sensor_error,  ///< torque or motor current is measured with an offset
  unknown,              ///< a fault of no other kind; the last one
};

inline constexpr int kFaultKinds = static_cast<int>(FaultKind::unknown) + 1;

/// Returns the name used in labels, JSON and reports, such as "free_swinging".
const char* to_string(FaultKind kind);
/// Returns the kind of that name. Throws Error(usage) that lists the names if `name` is none of them.
FaultKind fault_kind_from(const std::string& name);

/// A kind at a joint, or at the link that the joint moves; no joint if the fault belongs to none (none,
/// unknown).
struct FaultLabel {
  FaultKind kind = FaultKind::none;
  Joint joint{};

  bool operator==(const FaultLabel&) const = default;
};

/// Returns kind and joint for tables and messages: "torque_loss 2", or with " at joint " between them; the
/// kind alone if the fault belongs to no joint.
std::string label_text(const FaultLabel& label, const char* between = " ");

/// Classification of a fault by one network: the label of its largest output.
struct Opinion {
  FaultLabel label;
  double confidence = 0.0;  ///< 0 to 1

  bool operator==(const Opinion&) const = default;
};

/// Classification by both networks, the paper's dual classification.
struct Opinions {
  Opinion mlp;
  Opinion rbfn;

  bool operator==(const Opinions&) const = default;
};

}  // namespace faultline
