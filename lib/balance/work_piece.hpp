// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace faultline {

/// Level of a work piece in each row: 0 without it, 1 with it.
using PiecePath = std::vector<char>;

/// Returns the most likely path of levels (likely_states()). A row costs half the squares of `residual`
/// (without a piece) or `residual` - `piece` (with it) over `std` (all rows x joints), each limited, so that
/// an outlier decides nothing; a change costs kChangeOfPiece nats.
PiecePath piece_path(const Eigen::MatrixXd& residual, const Eigen::MatrixXd& piece,
                     const Eigen::MatrixXd& std);

inline constexpr double kChangeOfPiece = 10.0;  ///< nats of a change of the level: one in some 20000 rows

/// Returns the rows after which the level changes.
std::vector<int> changes_of(const PiecePath& path);

/// The path, smoothed as the rows are, and what each of its changes would add to it if it came 1 s earlier.
struct PieceRamps {
  Eigen::VectorXd level;   ///< by row
  Eigen::MatrixXd change;  ///< rows x changes
};

/// Returns the ramps of a path whose changes come `later_s` (empty: 0) after the middle of their two rows.
PieceRamps piece_ramps(const PiecePath& path, const Eigen::VectorXd& time_s, double kernel_s,
                       const Eigen::VectorXd& later_s = {});

/// Returns by row whether it lies within `reach` rows of a change.
std::vector<bool> near_change(const PiecePath& path, int reach);

}  // namespace faultline
