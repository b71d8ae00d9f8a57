// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/reproduce/reproduction.hpp"

namespace faultline {

/// A picture of each table whose id begins with "trade_off_": its figure columns over g, a panel each, a curve a
/// detector. Such tables have the label columns detector and g.
std::vector<Figure> trade_off_figures(const std::vector<ResultTable>& tables);

}  // namespace faultline
