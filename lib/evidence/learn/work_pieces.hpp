// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/evidence/learn/match_noise.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// Finds the work piece that healthy excerpts show to come and go: motions that carry it and motions that do
/// not, or else changes of the tip's mass within a motion that no other explanation fits, several times and
/// by the same mass; those that the model has already are taken as declared. Sets MotionModel::work_pieces_kg
/// and notes in each excerpt when they came and went. `unmatched` are the slow states before anything was
/// matched. Nothing changes where there is none.
void learn_work_pieces(MotionModel& model, const std::vector<SlowState>& unmatched,
                       std::vector<HealthyExcerpt>& excerpts, int threads);

/// Finds the mass of the model's only work piece again, from whole stretches with and without it. With noise
/// that was matched before it was known, much of what it weighs passes for a torque that the model misses.
void settle_work_piece(MotionModel& model, std::vector<HealthyExcerpt>& excerpts, int threads);

/// When work pieces of the model came and went in a healthy log, and what the filter makes of the tip's mass
/// at its start.
struct WorkPieceHistory {
  std::vector<WorkPieceChange> changes;
  double at_first_kg = 0.0;  ///< beside what was identified
};

/// Reads the log from its start.
WorkPieceHistory work_piece_history(LogSource& log, const MotionModel& model);

/// The tip may carry a work piece or not when a log begins, and the identified robot anything in between.
void allow_work_pieces(MotionModel& model);

}  // namespace faultline
