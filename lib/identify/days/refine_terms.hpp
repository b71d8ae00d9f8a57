// SPDX-License-Identifier: MIT
#pragma once

#include "lib/identify/days/healthy_day.hpp"

namespace faultline {

/// Refines the friction width of each joint on the residual after effects of the days and work piece.
DayDraft with_refined_widths(DayDraft draft);

/// Keeps the columns of those gear springs that explain their joint clearly better than a rigid gear, with
/// friction behind the spring. The column alone also fits residual friction when a light joint reverses.
DayDraft with_chosen_springs(DayDraft draft);

/// Sets the compliance of the gear springs from their columns: friction acts behind the spring.
BalanceModel with_compliance(BalanceModel model);

/// Adds torques that repeat with a position, if they explain a large part of the residual.
DayDraft with_ripples(DayDraft draft);

/// Frees rotors that act apart from the links if `are_looked_for`; one whose estimate is negative stays out.
DayDraft with_rotors(DayDraft draft, bool are_looked_for);

}  // namespace faultline
