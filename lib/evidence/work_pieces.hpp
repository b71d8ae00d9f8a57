// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/evidence/match_noise.hpp"

namespace faultline {

/// Finds the work piece that healthy excerpts show to come and go: changes of the tip's mass that no other
/// explanation fits, several times and by the same mass; those that the model has already are taken as
/// declared. Sets MotionModel::work_pieces_kg and notes in each excerpt when they came and went. Nothing
/// changes where there is none.
void learn_work_pieces(MotionModel& model, std::vector<HealthyExcerpt>& excerpts, int threads);

/// The tip may carry a work piece or not when a log begins, and the identified robot anything in between.
void allow_work_pieces(MotionModel& model);

}  // namespace faultline
