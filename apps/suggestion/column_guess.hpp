// SPDX-License-Identifier: MIT
#pragma once

#include "apps/suggestion/robot_guess.hpp"

namespace faultline {

/// Finds the channel of each column by their names, else by which column is the derivative of which; no units
/// yet. Throws Error(input) when no position is found.
std::vector<GuessedChannel> guess_columns(const RawExcerpt& excerpt);

/// False when name or unit of a column shows another quantity, such as a temperature, a counter, or a
/// velocity if `quantity` is a position.
bool may_be(const RawColumn& column, Quantity quantity);

/// Returns the raw values of the channel; for a time without a column the row numbers.
std::vector<double> values_of(const RawExcerpt& excerpt, const GuessedChannel& guess);

}  // namespace faultline
