// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lib/explain/day/day_effects.hpp"
#include "lib/explain/log_fit.hpp"

namespace faultline {

/// Returns the standard deviation of the rows of each joint over that of the healthy logs' rows.
std::vector<double> noise_levels(const LogFit& fit);

inline constexpr double kLoud = 1.5;  ///< times the noise of the healthy logs: a ripple is looked for

/// Returns the model with the ripples of this log that the healthy logs did not have, as effects of its day:
/// those that explain most of the residual, beside the known faults, of joints with at least kLoud times the
/// noise of the healthy logs. Returns none if no ripple explains as much.
std::optional<BalanceModel> with_ripples_of_day(const UniformLog& log, const BalanceModel& model,
                                                const std::vector<FaultClaim>& known = {});

/// Returns the amplitude of the ripples of the day of joint `j` (from 0) as an effect for reports; none
/// if it has none.
std::optional<DayEffect> ripple_of_day(const LogFit& fit, int j);

}  // namespace faultline
