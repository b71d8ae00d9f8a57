// SPDX-License-Identifier: MIT
#pragma once

namespace faultline {

/// Keeps what the solver's library writes about singular systems off the terminal: the result says it in its
/// own words. Errors that end the program are still written. May be called any number of times.
void quiet_solver();

}  // namespace faultline
