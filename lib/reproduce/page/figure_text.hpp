// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/reproduce/page/result_table.hpp"

namespace faultline {

/// "3.4e-3", "99.70 %" or "0.15" by the style; "-" for NaN.
std::string figure_text(double value, FigureStyle style);
/// The mean, and ± the spread where there is one.
std::string figure_text(const Measured& measured, FigureStyle style);

}  // namespace faultline
