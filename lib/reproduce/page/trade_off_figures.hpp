// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/reproduce/page/reproduction.hpp"

namespace faultline {

/// Whether pictures stand for this table on a page: how the criterion's g trades false alarms for delay.
bool is_trade_off(const ResultTable& table);

/// Pictures of the trade-off tables, whose label columns are detector ("recipe, network") and g: one a
/// recipe, the figure columns over g in a panel each, a curve a network.
std::vector<Figure> trade_off_figures(const std::vector<ResultTable>& tables);

}  // namespace faultline
