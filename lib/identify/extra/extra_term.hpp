// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/core/joint.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {

enum class ExtraKind {
  load_friction,    ///< share of the torque carried
  shared_inertia,   ///< rotor inertia of the chain's shared_drives[index]
  shared_viscous,   ///< viscous friction of the chain's shared_drives[index]
  shared_coulomb,   ///< Coulomb friction of the same
  ripple_cosine,    ///< cosine of the chain's ripples[index]
  ripple_sine,      ///< sine of the same
  gear_compliance,  ///< rad/(N m) or m/N, to first order; the chain's motion is that of a rigid gear
};

/// A linear parameter that is optional: most robots do not need it.
struct ExtraTerm {
  ExtraKind kind = ExtraKind::load_friction;
  Joint joint{};  ///< its joint, or the first that its shared drive turns
  int index = 0;  ///< index in the list of the chain that holds it
};

bool is_ripple(ExtraKind kind);
bool is_of_shared_drive(ExtraKind kind);
/// Whether both are of the same ripple or shared drive.
bool belong_together(const ExtraTerm& a, const ExtraTerm& b);
/// Whether the value is physically possible: friction never drives, no gear leads, and load friction takes
/// less than half of the torque carried.
bool is_possible(ExtraKind kind, double value);

/// Returns the terms of every load friction, shared drive and ripple that `chain` has, and of every
/// compliance in `gear_compliance` (by joint; may be empty) that is not 0.
std::vector<ExtraTerm> extra_terms_of(const Chain& chain, const std::vector<double>& gear_compliance);

/// Returns the place of a term's value in the chain; null if it has none, such as compliance.
double* extra_value(Chain& chain, const ExtraTerm& term);

/// Returns the torque of one unit of a term on every joint, at one state, if the gears carry the torque
/// `carried`. Zero for compliance.
JointVector extra_torque(const Chain& chain, const ExtraTerm& term, const JointVector& q,
                         const JointVector& dq, const JointVector& ddq, const JointVector& carried);

}  // namespace faultline
