// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "lib/fault/fault_catalogue.hpp"

namespace faultline {

/// How large the faults of one kind are in simulated runs.
struct TwinFault {
  std::array<DrawRange, kMostSizes> size{};  ///< as in the catalogue: shares of what is usual for the joint
  DrawRange length_s{};                      ///< of a kind that passes

  bool operator==(const TwinFault&) const = default;
};

/// The ranges that the catalogue gives, in the order of the kinds.
std::array<TwinFault, kFaultKinds> catalogued_twin_faults();

/// The distribution of the simulated runs: what the networks are trained on, what the case base holds and
/// what the validation of a model measures. Shares are of what the comment says; ranges without another word
/// are uniform. twin_fields.hpp says the same in words.
struct TwinOptions {
  // The run: long enough for some moves before and after any onset.
  double least_length_s = 5.0;
  double least_length_moves = 4.0;      ///< usual moves
  double least_length_samples = 150.0;  ///< so that coarse logs hold enough for the filters
  DrawRange onset{0.25, 0.7};  ///< of the length: the filters settle before it, evidence gathers after it

  // The motion: point to point in the range of the logs, about as fast as the logs.
  double quintic_share = 0.5;  ///< of runs; the rest has trapezoidal speed, whose torque jumps
  double shortest_move_s =
      0.3;  ///< bounds of the usual move, which follows from range and speed of the logs;
  double longest_move_s = 10.0;  ///< a joint that hardly moved would ask for absurd ones
  DrawRange move{0.8, 1.3};      ///< of the usual move: the logs' speed is a mean of moves like these
  DrawRange dwell{0.05, 0.4};    ///< of the usual move: rests hide most faults, so runs are mostly motion

  // The controller, which logs do not tell.
  double pd_share = 0.25;           ///< of runs under PD, the rest under computed torque
  double mass_error = 0.05;         ///< of each mass, at most: how well a controller knows its robot
  double control_period_s = 0.001;  ///< of robots whose torque changes between samples; usual for drives
  double integration_share = 0.1;   ///< of the control period, at least control_period_s: longest step
  double trip_speed = 12.0;         ///< of the usual speed: drives trip where a run has gone astray
  int attempts = 4;                 ///< controllers drawn until one holds the robot up to the onset

  // The machine.
  double stop_share = 0.6;             ///< of runs with end stops, onto which a freed joint may fall
  DrawRange stop_distance{0.05, 0.6};  ///< of the range, beyond it on either side

  // The faults.
  double second_push_share = 0.4;   ///< of faults that pass: a contact at the tip pushes another joint too
  DrawRange second_push{0.2, 0.8};  ///< of the first push, each against the joint's largest torque
  std::array<TwinFault, kFaultKinds> faults = catalogued_twin_faults();

  bool operator==(const TwinOptions&) const = default;
  /// Throws Error(usage) naming the field, its value and its bound.
  void check() const;
};

}  // namespace faultline
