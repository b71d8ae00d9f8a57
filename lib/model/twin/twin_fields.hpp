// SPDX-License-Identifier: MIT
#pragma once

namespace faultline {

/// Calls visit(key, value, words) for each number and range of TwinOptions except those of the faults, in the
/// order of display; the words state unit and meaning.
template <typename Options, typename Visit>
void visit_twin_fields(Options& o, Visit visit) {
  visit("least_length_s", o.least_length_s, "s, length of a run at least");
  visit("least_length_moves", o.least_length_moves, "usual moves in a run at least");
  visit("least_length_samples", o.least_length_samples, "samples in a run at least");
  visit("onset", o.onset, "of the run: when the fault begins");
  visit("quintic_share", o.quintic_share, "of runs move by quintics, the rest by trapezoids");
  visit("shortest_move_s", o.shortest_move_s, "s, usual move of the logs at least");
  visit("longest_move_s", o.longest_move_s, "s, usual move of the logs at most");
  visit("move", o.move, "of the usual move: length of a move");
  visit("dwell", o.dwell, "of the usual move: rest after a move");
  visit("pd_share", o.pd_share, "of runs under PD, the rest under computed torque");
  visit("mass_error", o.mass_error, "of each mass at most: error of the controller's model");
  visit("control_period_s", o.control_period_s, "s, if the torque changes between samples");
  visit("integration_share", o.integration_share, "of the control period: longest step of integration");
  visit("trip_speed", o.trip_speed, "of the usual speed: the drives trip");
  visit("attempts", o.attempts, "controllers drawn until one holds the robot");
  visit("stop_share", o.stop_share, "of runs with end stops");
  visit("stop_distance", o.stop_distance, "of the range: end stops beyond it");
  visit("second_push_share", o.second_push_share, "of collisions that push a second joint");
  visit("second_push", o.second_push, "of the first push: the second");
}

}  // namespace faultline
