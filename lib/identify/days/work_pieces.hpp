// SPDX-License-Identifier: MIT
#pragma once

#include "lib/identify/days/healthy_day.hpp"

namespace faultline {

/// The model with the mass of a work piece that comes and goes, and with the robot's mass in the rows without
/// it; unchanged when no such mass stands out in the days. Masses that some rows each ask for are split into
/// two groups.
DayDraft with_first_piece(DayDraft draft);

/// Paths of the work piece in each day by what robot and effects of the day leave, and its mass by these
/// paths. `is_rough`: the robot is still far off, so that only a step of most of the piece counts.
DayDraft with_piece_paths(DayDraft draft, bool is_rough);

}  // namespace faultline
