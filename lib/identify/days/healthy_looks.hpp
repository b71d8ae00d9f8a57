// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/days/healthy_day.hpp"

namespace faultline {

/// The model with ranges, speeds, noise and repeated positions of the healthy logs.
BalanceModel with_looks(const std::vector<HealthyDay>& days, BalanceModel model);

}  // namespace faultline
