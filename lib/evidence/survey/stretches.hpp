// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "lib/evidence/motion_model.hpp"
#include "lib/log/log.hpp"

namespace faultline {

/// A survey cuts the rows it looks at into so many stretches of the same length.
inline constexpr int kStretches = 8;

inline std::size_t stretch_of(int row, int rows) { return static_cast<std::size_t>(row) * kStretches / rows; }

/// The first two stretches in which the robot moves.
std::vector<int> first_moving(const Log& rows, const MotionModel& model);

/// How far the joints go in each stretch, each against its usual speed, s.
std::array<double, kStretches> way_of(const Log& rows, const MotionModel& model);

}  // namespace faultline
