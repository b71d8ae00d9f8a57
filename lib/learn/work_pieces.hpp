// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/identify/days/fit_days.hpp"
#include "lib/log/log_source.hpp"
#include "lib/log/transformed/selected_rows_source.hpp"

namespace faultline {

/// Returns by log the rows without a work piece, since one that is carried half of the time shifts masses and
/// friction of a robot identified from all rows. Empty if these rows are too few for an identification, or no
/// work piece comes and goes. `logs` are those that `days` were fitted to. Rewinds them.
std::vector<std::vector<RowRange>> rows_without_work_piece(std::span<LogSource* const> logs,
                                                           const FittedDays& days);

}  // namespace faultline
