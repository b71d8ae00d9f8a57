// SPDX-License-Identifier: MIT
#include "lib/balance/work_piece.hpp"

#include <algorithm>
#include <cmath>

#include "lib/balance/likely_states.hpp"
#include "lib/balance/smoothing.hpp"

namespace faultline {
namespace {

constexpr double kMostSquare = 50.0;  // largest squared deviation of one value that counts: limits an outlier
constexpr double kNoEvidence = 1e6;   // N m or N: a value with such a standard deviation does not count
constexpr double kSurely = 6.5;       // kernels from a change, beyond which it has no effect

double cost(double residual, double std) {
  const double z = residual / std;
  return 0.5 * std::min(z * z, kMostSquare);
}

}  // namespace

PiecePath piece_path(const Eigen::MatrixXd& residual, const Eigen::MatrixXd& piece,
                     const Eigen::MatrixXd& std) {
  Eigen::MatrixX2d nats = Eigen::MatrixX2d::Zero(residual.rows(), 2);
  for (Eigen::Index k = 0; k < residual.rows(); ++k)
    for (Eigen::Index j = 0; j < residual.cols(); ++j) {
      if (std(k, j) >= kNoEvidence) continue;
      nats(k, 0) += cost(residual(k, j), std(k, j));
      nats(k, 1) += cost(residual(k, j) - piece(k, j), std(k, j));
    }
  return likely_states(nats, kChangeOfPiece);
}

std::vector<int> changes_of(const PiecePath& path) {
  std::vector<int> out;
  for (int k = 0; k + 1 < static_cast<int>(path.size()); ++k)
    if (path[k] != path[k + 1]) out.push_back(k);
  return out;
}

PieceRamps piece_ramps(const PiecePath& path, const Eigen::VectorXd& time_s, double kernel_s,
                       const Eigen::VectorXd& later_s) {
  const int rows = static_cast<int>(path.size());
  const std::vector<int> changes = changes_of(path);
  PieceRamps out;
  out.level.setConstant(rows, rows > 0 ? path[0] : 0);
  out.change.setZero(rows, static_cast<int>(changes.size()));
  for (std::size_t c = 0; c < changes.size(); ++c) {
    const double at = 0.5 * (time_s[changes[c]] + time_s[changes[c] + 1]) +
                      (later_s.size() > 0 ? later_s[static_cast<int>(c)] : 0.0);
    const double step = path[changes[c] + 1] - path[changes[c]];
    for (int k = 0; k < rows; ++k) {
      const double x = (time_s[k] - at) / kernel_s;
      out.level[k] += step * normal_cdf(x);
      if (std::abs(x) > kSurely) continue;
      out.change(k, static_cast<int>(c)) = step * normal_density(time_s[k] - at, kernel_s);
    }
  }
  return out;
}

std::vector<bool> near_change(const PiecePath& path, int reach) {
  const int rows = static_cast<int>(path.size());
  std::vector<bool> out(rows, false);
  for (const int k : changes_of(path))
    for (int i = std::max(0, k - reach + 1); i <= std::min(rows - 1, k + reach); ++i) out[i] = true;
  return out;
}

}  // namespace faultline
