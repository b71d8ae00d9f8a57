// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "lib/log/log_source.hpp"

namespace faultline {

/// Code of the issue that the columns of a log change their meaning at a row.
inline constexpr const char* kChangedColumns = "columns_changed";

/// Returns the log without the effects of its recorder, if the log itself proves them:
/// - an angle that was kept within one turn is continued beyond it (angle_unwrapped);
/// - rows in which the recorder stood still or wrote zeros lose their values (recorder_stopped, rows_blank);
/// - if two or more joints jump at once, further than their velocities allow, rows are missing or repeated:
///   the repeated ones, or the first few after the jump, are left out, so that the log has a gap there and no
///   stage draws conclusions across it (rows_cut_out, block_repeated);
/// - if two joints continue as each other, columns_changed names the row.
/// A jump, a standstill or zeros of a single joint have no such effect: its sensor may be faulty.
/// `slides`: whether each joint slides and so has no turns; empty if unknown. `source` outlives the result.
std::unique_ptr<LogSource> corrected(LogSource& source, std::vector<bool> slides = {});

/// Returns the source, corrected, without values that the recorder did not measure
/// (without_stopped_columns()).
std::unique_ptr<LogSource> mended(std::unique_ptr<LogSource> source, std::vector<bool> slides = {});

}  // namespace faultline
