// SPDX-License-Identifier: MIT
#pragma once

#include "lib/explain/coarse/coarse_judge.hpp"

namespace faultline {

/// What a unit of the false reading of `guess` adds to the readings (2 joints x samples) from sample `from`
/// on.
Eigen::MatrixXd read_column(const CoarseLog& log, const CoarseGuess& guess, int from);

}  // namespace faultline
