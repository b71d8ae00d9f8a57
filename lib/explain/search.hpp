// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/explain/hypothesis.hpp"

namespace faultline {

inline constexpr double kLead_s = 0.5;  ///< at the start of a log, in which no onset is looked for
inline constexpr int kTail = 5;         ///< rows at the end in which none is looked for

/// An onset worth judging for one kind and joint.
struct Candidate {
  FaultKind kind = FaultKind::none;
  int joint = 0;  ///< from 1
  double onset_s = 0.0;
  double score = 0.0;  ///< nats under white noise: for the choice of onsets only
  double start = 0.0;  ///< size of a sensor fault to begin with
};

/// Columns of the faults that stay and are linear: torque loss and friction of each joint, payload at the
/// tip.
struct LinearFault {
  FaultKind kind = FaultKind::none;
  int joint = 0;  ///< from 1
  FaultColumns columns;
  std::vector<Eigen::VectorXd> starts;  ///< sizes to search the path of a work piece from
};

std::vector<LinearFault> linear_faults(const LogFit& fit);

/// Onsets that stand out, for every kind and joint. One pass gives the score of a linear column for every
/// onset from cumulative normal equations.
std::vector<Candidate> search(const LogFit& fit, const std::vector<LinearFault>& linear);

/// Column `joint` (from 0) of the inertia matrix in each row: rows x joints.
Eigen::MatrixXd inertia_columns(const LogFit& fit, int joint);

/// Mass that the last joint carries, kg, as its torque shows it.
double carried_mass(const LogFit& fit);

}  // namespace faultline
