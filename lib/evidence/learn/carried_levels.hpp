// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lib/evidence/learn/match_noise.hpp"
#include "lib/evidence/motion_model.hpp"

namespace faultline {

/// What a motion from one rest to the next says of the mass at the tip by itself.
struct CarriedLevel {
  double kg = 0.0;  ///< beside what was identified
  double std = 0.0;
  std::int64_t row = 0;                  ///< of the log, in the rest before it: where it may have changed
  std::array<double, kMaxJoints> way{};  ///< of sliding axes, where it ends less where it began, m
};

/// The levels of the motions of an excerpt, in the order of time: the tip's mass may be another after every
/// rest. `model` is one whose coloured torques are small: matched to logs whose work piece nobody knew, they
/// take most of what it weighs.
std::vector<CarriedLevel> carried_levels(const MotionModel& model, const HealthyExcerpt& excerpt);

/// A mass that comes and goes between motions.
struct ShownPiece {
  double kg = 0.0;         ///< 0 for none
  double border_kg = 0.0;  ///< levels above it carry the piece
  double most_std = 0.0;   ///< levels known worse tell nothing
};

/// The mass by which the levels of the logs jump between two values, several times within a log; none where
/// they scatter around one, differ from log to log only, or differ with the direction of a sliding axis, as
/// its friction would.
ShownPiece piece_that_comes_and_goes(const std::vector<std::vector<CarriedLevel>>& logs);

/// When the piece came and went in a log.
std::vector<WorkPieceChange> changes_between(const std::vector<CarriedLevel>& levels,
                                             const ShownPiece& piece);

}  // namespace faultline
