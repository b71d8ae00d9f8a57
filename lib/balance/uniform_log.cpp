// SPDX-License-Identifier: MIT
#include "lib/balance/uniform_log.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/error.hpp"
#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

constexpr double kEarliest =
    0.3;  // of a period by which a stamp may be late and still belong to its grid point
constexpr double kNormalMad = 0.6745;       // median of |x| of a standard normal x
constexpr double kFourthDifference = 70.0;  // sum of the squares of 1, -4, 6, -4, 1

bool is_complete(const Log& log, int row) {
  for (int j = 0; j < log.joints(); ++j) {
    if (!std::isfinite(log.q[j][row]) || !std::isfinite(log.tau[j][row])) return false;
    if (!log.dq.empty() && !std::isfinite(log.dq[j][row])) return false;
  }
  return std::isfinite(log.time[row]);
}

/// Fills the lost rows of a column by straight lines between the rows that are there.
void interpolate(const std::vector<bool>& lost, Eigen::Ref<Eigen::VectorXd> values) {
  const int rows = static_cast<int>(values.size());
  int before = -1;
  for (int k = 0; k < rows; ++k) {
    if (lost[k]) continue;
    for (int i = before + 1; i < k; ++i) {
      const double share = before < 0 ? 1.0 : static_cast<double>(i - before) / (k - before);
      values[i] = before < 0 ? values[k] : values[before] + share * (values[k] - values[before]);
    }
    before = k;
  }
  for (int i = before + 1; i < rows && before >= 0; ++i) values[i] = values[before];
}

}  // namespace

UniformLog uniform_log(LogSource& log, double period_s) {
  const Log all = read_all(log);
  std::vector<std::pair<int, int>> kept;  // grid point, row
  double start = 0.0;
  for (int row = 0; row < all.rows(); ++row) {
    if (!is_complete(all, row)) continue;
    if (kept.empty()) start = all.time[row];
    const int point = static_cast<int>(std::floor((all.time[row] - start) / period_s + kEarliest));
    if (kept.empty() || point > kept.back().first) kept.emplace_back(point, row);
  }
  if (kept.size() < 2)
    throw Error(ErrorCode::input, log.identity().path,
                "has fewer than two rows with all values; nothing can be said of it");
  UniformLog out;
  out.start_s = start;
  out.period_s = period_s;
  const int rows = kept.back().first + 1, joints = all.joints();
  out.q.setZero(rows, joints);
  out.tau.setZero(rows, joints);
  out.dq.setZero(all.dq.empty() ? 0 : rows, joints);
  out.lost.assign(rows, true);
  for (const auto& [point, row] : kept) {
    out.lost[point] = false;
    for (int j = 0; j < joints; ++j) {
      out.q(point, j) = all.q[j][row];
      out.tau(point, j) = all.tau[j][row];
      if (!all.dq.empty()) out.dq(point, j) = all.dq[j][row];
    }
  }
  for (int j = 0; j < joints; ++j) {
    interpolate(out.lost, out.q.col(j));
    interpolate(out.lost, out.tau.col(j));
    if (out.dq.rows() > 0) interpolate(out.lost, out.dq.col(j));
  }
  return out;
}

Eigen::VectorXd sample_noise(const Eigen::MatrixXd& values) {
  Eigen::VectorXd noise(values.cols());
  for (int j = 0; j < values.cols(); ++j) {
    std::vector<double> size;
    for (int k = 4; k < values.rows(); ++k)
      size.push_back(std::abs(values(k, j) - 4.0 * values(k - 1, j) + 6.0 * values(k - 2, j) -
                              4.0 * values(k - 3, j) + values(k - 4, j)));
    noise[j] =
        size.empty() ? 0.0 : upper_median(std::move(size)) / (kNormalMad * std::sqrt(kFourthDifference));
  }
  return noise;
}

}  // namespace faultline
