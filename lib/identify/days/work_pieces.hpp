// SPDX-License-Identifier: MIT
#pragma once

#include "lib/identify/days/healthy_day.hpp"

namespace faultline {

/// Adds the mass of a work piece that comes and goes, and sets the robot's mass to that of the rows without
/// it; unchanged if no such mass stands out in the days. The mass at the tip is estimated from short
/// stretches of rows, and these masses are split into two groups.
DayDraft with_first_piece(DayDraft draft);

/// Estimates the path of the work piece in each day from the residual of robot and day effects, and its mass
/// from these paths. `is_rough`: the robot is still inaccurate, so only a step of most of that mass counts.
DayDraft with_piece_paths(DayDraft draft, bool is_rough);

}  // namespace faultline
