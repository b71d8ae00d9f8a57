// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/core/random.hpp"
#include "lib/simulate/fault_event.hpp"

namespace faultline {

/// A work piece that the robot picks up and puts down in healthy operation.
struct WorkPieceSpec {
  double mass = 0.0;           ///< kg; 0: none
  double carried_min_s = 1.0;  ///< time between picking up and putting down, drawn uniformly
  double carried_max_s = 3.0;
  double empty_min_s = 1.0;  ///< time before picking up, drawn uniformly
  double empty_max_s = 3.0;
};

/// Throws Error(usage) naming the key if the mass or a time is not valid.
void check_work_piece(const WorkPieceSpec& spec);

/// Returns when a run of `duration_s`, which begins with an empty tool, carries the piece, as changes of
/// payload for the plant. The piece already has the tip's velocity when it is picked up.
std::vector<SimulatedFault> carried(const WorkPieceSpec& spec, int joints, double duration_s, Random random);

}  // namespace faultline
