// SPDX-License-Identifier: MIT
#include "lib/balance/uniform_log.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/error.hpp"
#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

constexpr double kPeriodGrid_s = 1e-6;  // to which a sample period is rounded
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

UniformLog on_grid(const Log& all, const std::string& path, double period_s) {
  std::vector<std::pair<int, int>> kept;  // grid point, row
  double start = 0.0;
  for (int row = 0; row < all.rows(); ++row) {
    if (!is_complete(all, row)) continue;
    if (kept.empty()) start = all.time[row];
    const int point = static_cast<int>(std::floor((all.time[row] - start) / period_s + kEarliest));
    if (kept.empty() || point > kept.back().first) kept.emplace_back(point, row);
  }
  if (kept.size() < 2)
    throw Error(ErrorCode::input, path, "has fewer than two rows with all values; nothing can be said of it");
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

}  // namespace

UniformLog uniform_log(LogSource& log, double period_s) {
  return on_grid(read_all(log), log.identity().path, period_s);
}

std::vector<UniformLog> uniform_logs(std::span<LogSource* const> logs) {
  std::vector<Log> read;
  std::vector<double> steps;
  for (LogSource* log : logs) {
    log->rewind();
    read.push_back(read_all(*log));
    const std::vector<double>& time = read.back().time;
    for (std::size_t k = 1; k < time.size(); ++k) steps.push_back(time[k] - time[k - 1]);
  }
  if (steps.empty()) throw Error(ErrorCode::input, "", "there are no logs to learn from");
  const double period = std::round(upper_median(std::move(steps)) / kPeriodGrid_s) * kPeriodGrid_s;
  std::vector<UniformLog> out;
  for (std::size_t k = 0; k < logs.size(); ++k)
    out.push_back(on_grid(read[k], logs[k]->identity().path, period));
  return out;
}

Eigen::VectorXd joint_medians(const std::vector<Eigen::VectorXd>& by_log) {
  Eigen::VectorXd out(by_log.front().size());
  for (int j = 0; j < out.size(); ++j) {
    std::vector<double> values;
    for (const Eigen::VectorXd& of_log : by_log) values.push_back(of_log[j]);
    out[j] = upper_median(std::move(values));
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
