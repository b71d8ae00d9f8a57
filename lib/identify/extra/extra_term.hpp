// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/robot/chain.hpp"

namespace faultline {

enum class ExtraKind {
  load_friction,    ///< share of the torque carried
  shared_inertia,   ///< rotor of the chain's shared_drives[index]
  shared_viscous,   ///< of the chain's shared_drives[index]
  shared_coulomb,   ///< the same
  ripple_cosine,    ///< of the chain's ripples[index]
  ripple_sine,      ///< the same
  gear_compliance,  ///< rad/(N m) or m/N, to first order; the chain's motion is that of a rigid gear
};

/// A linear parameter that few robots have.
struct ExtraTerm {
  ExtraKind kind = ExtraKind::load_friction;
  int joint = 0;  ///< from 0: its own, or the first that its drive turns with
  int index = 0;  ///< where the chain keeps it
};

bool is_ripple(ExtraKind kind);
bool is_of_shared_drive(ExtraKind kind);
/// Whether they are of the same ripple or drive.
bool belong_together(const ExtraTerm& a, const ExtraTerm& b);
/// Whether a robot can have that value: friction never drives, no gear leads or loses half of what it
/// carries.
bool is_possible(ExtraKind kind, double value);

/// The terms of every load friction, shared drive and ripple that `chain` has, and for every compliance in
/// `gear_compliance` (by joint; may be empty) that is not 0.
std::vector<ExtraTerm> extra_terms_of(const Chain& chain, const std::vector<double>& gear_compliance);

/// Where the chain keeps a term's value; null where it has none, as of compliance.
double* extra_value(Chain& chain, const ExtraTerm& term);
const double* extra_value(const Chain& chain, const ExtraTerm& term);

/// The torque on every joint that a unit of a term is, at one state, where gears carry `carried`.
/// Compliance has none.
JointVector extra_torque(const Chain& chain, const ExtraTerm& term, const JointVector& q,
                         const JointVector& dq, const JointVector& ddq, const JointVector& carried);

}  // namespace faultline
