// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/evidence/learn/match_noise.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// What tells of a work piece, and when it came and went.
enum class ToldBy {
  nothing,
  statement,  ///< declared
  motions,    ///< some carry it and some do not
  changes,    ///< of the tip's mass within a motion, which no other explanation fits
};

/// Finds the work piece that healthy excerpts show to come and go several times; those that the model has
/// already are taken as declared. Sets MotionModel::work_pieces_kg and notes in each excerpt when they came
/// and went. `unmatched` are the slow states before anything was matched: matched to logs whose piece nobody
/// knew, they take most of what it weighs for a torque that the model misses. Nothing changes where there is
/// none.
ToldBy learn_work_pieces(MotionModel& model, const std::vector<SlowState>& unmatched,
                         std::vector<HealthyExcerpt>& excerpts, int threads);

/// Finds the mass of the model's only work piece again, from whole stretches with and without it, and when it
/// came and went where motions do not tell.
void settle_work_piece(MotionModel& model, ToldBy told, std::vector<HealthyExcerpt>& excerpts, int threads);

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
