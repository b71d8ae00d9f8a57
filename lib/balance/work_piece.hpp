// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace faultline {

/// Level of a work piece in each row: 0 without it, 1 with it.
using PiecePath = std::vector<char>;

/// The likeliest path of levels (Viterbi 1967): each row costs what `residual` (without a piece) or
/// `residual` less `piece` leaves of it in standard deviations `std` (all rows x joints), at most so much
/// that an outlier decides nothing; each change costs kChangeOfPiece nats.
PiecePath piece_path(const Eigen::MatrixXd& residual, const Eigen::MatrixXd& piece,
                     const Eigen::MatrixXd& std);

inline constexpr double kChangeOfPiece = 10.0;  ///< nats: a change in some 20000 rows

/// Rows behind which the level changes.
std::vector<int> changes_of(const PiecePath& path);

/// The path smoothed as the rows are, and for each of its changes what it would add to come earlier by 1 s.
struct PieceRamps {
  Eigen::VectorXd level;   ///< by row
  Eigen::MatrixXd change;  ///< rows x changes
};

/// Each change comes `later_s` (empty: 0) than the middle between its two rows.
PieceRamps piece_ramps(const PiecePath& path, const Eigen::VectorXd& time_s, double kernel_s,
                       const Eigen::VectorXd& later_s = {});

/// Rows within `reach` rows of a change.
std::vector<bool> near_change(const PiecePath& path, int reach);

}  // namespace faultline
