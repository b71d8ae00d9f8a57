// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/log/log.hpp"
#include "lib/plausibility/column_reading.hpp"

namespace faultline {

/// How many times too far apart the rows are for a model whose logs have one every `sample_period_s`; 1 where
/// they are not.
double clock_ratio(const Log& rows, double sample_period_s);

/// Stamps that run that many times too fast; none for 1.
std::vector<ColumnReading> clock_readings(double ratio, double sample_period_s);

/// Torques logged late or early by two rows to a quarter of `rows`, in steps of a third.
std::vector<ColumnReading> delay_readings(const Log& rows);

}  // namespace faultline
