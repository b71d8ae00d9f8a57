// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "lib/core/random.hpp"
#include "lib/identify/identification.hpp"
#include "lib/identify/usual_motion.hpp"
#include "lib/model/twin/twin_options.hpp"
#include "lib/simulate/simulate.hpp"

namespace faultline {

/// How far healthy days of a robot differ, and the torque that its model misses, as standard deviations; one
/// number a joint, 0 for none.
struct DayDifferences {
  std::vector<double> friction;         ///< share of viscous and Coulomb friction
  std::vector<double> viscous_excess;   ///< share by which viscous friction exceeds Coulomb friction
  std::vector<double> gain;             ///< share of the torque that the drive gives
  std::vector<double> offset;           ///< N m or N that the drive gives beside what is logged
  std::vector<double> missed;           ///< N m or N: ripple, springs, shape of friction
  std::vector<double> missed_memory_s;  ///< correlation time of the missed torque

  static DayDifferences none(int joints);
};

/// The data of a robot from which the twin makes runs that resemble its logs.
struct Twin {
  const Identification* identification = nullptr;
  const UsualMotion* motion = nullptr;
  DayDifferences days{};
  double sample_period_s = 0.0;
  bool has_velocity = true;
  TwinOptions options{};
};

/// A simulated run with the requested fault; FaultKind::none for a healthy one.
struct TwinRun {
  Log log;
  FaultLabel label;
  double onset_s = 0.0;
  double end_s = std::numeric_limits<double>::infinity();  ///< of a fault that passes
  double size = 0.0;                                       ///< SimulatedFault::size
};

/// Length of a run, s: long enough for a few moves after any onset.
double twin_run_length_s(const Twin& twin);

/// Simulates a run of the identified robot with its parameters drawn from their uncertainty, motion within
/// the range and about the speed of its logs, controller and fault size at random, noise as measured. The
/// same seed gives the same run.
TwinRun twin_run(const Twin& twin, const FaultLabel& label, std::uint64_t seed);

/// Draws the faults of a run: the requested one, and for a kind that passes possibly a second push at another
/// joint.
std::vector<SimulatedFault> draw_faults(const Twin& twin, const FaultLabel& label, double onset_s,
                                        Random& random);

}  // namespace faultline
