// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/evidence/motion_model.hpp"
#include "lib/log/log_source.hpp"
#include "lib/log/transformed/selected_rows_source.hpp"

namespace faultline {

/// By log, the rows in which the robot carries no work piece, as far as the filters can tell: a piece that is
/// carried half of the time shifts masses and friction of a robot identified from all rows. Empty where they
/// are too few to identify it from, or where the model has no work pieces.
std::vector<std::vector<RowRange>> rows_without_work_piece(std::span<LogSource* const> logs,
                                                           const MotionModel& model, int threads);

}  // namespace faultline
