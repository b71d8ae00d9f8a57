// SPDX-License-Identifier: MIT
#pragma once

#include "apps/suggestion/robot_guess.hpp"

namespace faultline {

/// Which column is which channel, by their names, else by which one is the derivative of which. No units yet.
/// Throws Error(input) when no position can be told.
std::vector<GuessedChannel> guess_columns(const RawExcerpt& excerpt);

/// Whether neither name nor unit of a column says that it is something else than the quantity, such as a
/// temperature, a counter or a velocity that is no position.
bool may_be(const RawColumn& column, Quantity quantity);

/// The guessed channel's raw values; the row numbers for a time that is none.
std::vector<double> values_of(const RawExcerpt& excerpt, const GuessedChannel& guess);

}  // namespace faultline
