// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lib/fault/fault_catalogue.hpp"

namespace faultline {

/// Sizes of the faults of one kind in simulated runs.
struct TwinFault {
  std::array<DrawRange, kMostSizes> size{};  ///< as in the catalogue: shares of the joint's usual value
  DrawRange length_s{};                      ///< for a kind that passes

  bool operator==(const TwinFault&) const = default;
};

/// Returns the ranges of the catalogue, in the order of the kinds.
std::array<TwinFault, kFaultKinds> catalogued_twin_faults();

/// Distribution of the simulated runs: training data of the networks, content of the case base and data of
/// the validation of a model. Each comment names the reference of a share; ranges are uniform if not stated
/// otherwise. twin_text() has the same meanings as words.
struct TwinOptions {
  // The run: long enough for some moves before and after any onset.
  double least_length_s = 5.0;
  double least_length_moves = 4.0;      ///< in usual moves
  double least_length_samples = 150.0;  ///< so that coarse logs are long enough for the filters
  DrawRange onset{0.25, 0.7};  ///< share of the length: the filters settle before it, evidence grows after it

  // The motion: point to point in the range of the logs, about as fast as in the logs.
  double quintic_share = 0.5;  ///< of runs; the others have trapezoidal speed, whose torque jumps
  double shortest_move_s =
      0.3;  ///< bounds of the usual move, which is computed from range and speed of the logs
  double longest_move_s = 10.0;  ///< and would be extreme for a joint that hardly moved
  DrawRange move{0.8, 1.3};      ///< of the usual move: the logs' speed is a mean over such moves
  DrawRange dwell{0.05, 0.4};    ///< of the usual move: rests hide most faults, so runs are mostly motion

  // The controller, which cannot be identified from logs.
  double pd_share = 0.25;           ///< of runs with PD control, the others with computed torque
  double mass_error = 0.05;         ///< of each mass, at most: error of the controller's model
  double control_period_s = 0.001;  ///< if the torque changes between samples; usual for drives
  double integration_share = 0.1;   ///< longest step, of the control period, at least control_period_s
  double trip_speed = 12.0;         ///< of the usual speed: the drives trip if the motion diverges
  int attempts = 4;                 ///< controllers drawn until a run lasts beyond the onset

  // The machine.
  double stop_share = 0.6;             ///< of runs with end stops, onto which a free joint may fall
  DrawRange stop_distance{0.05, 0.6};  ///< of the range, beyond it on either side

  // The faults.
  double second_push_share = 0.4;   ///< of faults that pass: a contact at the tip also pushes another joint
  DrawRange second_push{0.2, 0.8};  ///< of the first push, each relative to the joint's largest torque
  std::array<TwinFault, kFaultKinds> faults = catalogued_twin_faults();

  bool operator==(const TwinOptions&) const = default;
  /// Throws Error(usage) naming the field, its value and its bound if a field is out of bounds.
  void check() const;
};

/// Returns the distribution of the simulated runs as a table for people.
std::string twin_text(const TwinOptions& options);

/// Returns every number and, under "faults", the ranges of each kind that has a size.
nlohmann::ordered_json twin_to_json(const TwinOptions& options);
/// Throws Error(input) if something is missing or no number; `where` names the file. Kinds that are not
/// listed keep the catalogue's ranges.
TwinOptions twin_from_json(const nlohmann::ordered_json& json, const std::string& where);

}  // namespace faultline
