// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "lib/log/log_source.hpp"

namespace faultline {

struct ResampleOptions {
  double period_s = 0.001;  ///< of the new rows, which start at the first recorded time
  double longest_gap_s =
      0.0;  ///< no rows are made between samples further apart; 0 = 3 periods of either log
};

/// The log at a fixed sample period, by straight lines between neighbouring samples; a value is missing where
/// one of its neighbours is. Rows are neither made inside gaps nor beyond the last sample. There is no
/// low-pass: a much longer period folds fast motion into slow. `rows_read` and the issues stay those of the
/// recorded log. Throws Error(usage) unless the period is positive.
std::unique_ptr<LogSource> resampled(std::unique_ptr<LogSource> source, const ResampleOptions& options);

}  // namespace faultline
