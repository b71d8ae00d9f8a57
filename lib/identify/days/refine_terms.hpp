// SPDX-License-Identifier: MIT
#pragma once

#include "lib/identify/days/healthy_day.hpp"

namespace faultline {

/// The friction width of each joint searched again, effects of the days and the work piece taken away.
DayDraft with_refined_widths(DayDraft draft);

/// Keeps the columns of those gear springs that explain their joint clearly better than a rigid gear, with
/// the friction behind the spring. The column alone also fits what friction leaves where a light joint
/// reverses.
DayDraft with_chosen_springs(DayDraft draft);

/// Compliance of the gear springs from their columns: friction acts behind the spring.
BalanceModel with_compliance(BalanceModel model);

/// Torques that repeat with a position, where they explain much of what is left.
DayDraft with_ripples(DayDraft draft);

/// Rotors that links do not show are free where `are_looked_for`, until one comes out negative.
DayDraft with_rotors(DayDraft draft, bool are_looked_for);

}  // namespace faultline
