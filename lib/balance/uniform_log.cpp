// SPDX-License-Identifier: MIT
#include "lib/balance/uniform_log.hpp"

#include <algorithm>
#include <cmath>

#include "lib/balance/sample_grid.hpp"
#include "lib/core/error.hpp"
#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

constexpr double kPeriodGrid_s = 1e-9;  // to which a sample period is rounded
constexpr double kBridged_s = 0.007;    // longest gap that is bridged and not lost: shorter than the kernels
constexpr double kSameTime_s = 1e-9;    // between two times that count as equal
constexpr double kNormalMad = 0.6745;   // median of |x| of a standard normal x
constexpr double kFourthDifference = 70.0;  // sum of the squares of 1, -4, 6, -4, 1

bool is_complete(const Log& log, int row) {
  for (int j = 0; j < log.joints(); ++j) {
    if (!std::isfinite(log.q[j][row]) || !std::isfinite(log.tau[j][row])) return false;
    if (!log.dq.empty() && !std::isfinite(log.dq[j][row])) return false;
  }
  return std::isfinite(log.time[row]);
}

/// Returns the value at `at` between rows `before` and `after`: of the cubic through two rows on each side if
/// `is_smooth` and they exist, else of a straight line. Rows that repeat one value are bridged by it.
double between(const std::vector<bool>& lost, const Eigen::Ref<const Eigen::VectorXd>& values, int before,
               int after, int at, bool is_smooth) {
  const double share = static_cast<double>(at - before) / (after - before);
  const bool has_four = before > 0 && after + 1 < values.size() && !lost[before - 1] && !lost[after + 1];
  if (!is_smooth || !has_four) return values[before] + share * (values[after] - values[before]);
  const int row[4] = {before - 1, before, after, after + 1};
  if (std::all_of(row, row + 4, [&](int i) { return values[i] == values[before]; })) return values[before];
  double sum = 0.0;
  for (const int i : row) {
    double weight = values[i];
    for (const int k : row)
      if (k != i) weight *= static_cast<double>(at - k) / (i - k);
    sum += weight;
  }
  return sum;
}

/// Interpolates the lost rows of a column from the others.
void interpolate(const std::vector<bool>& lost, bool is_smooth, Eigen::Ref<Eigen::VectorXd> values) {
  const int rows = static_cast<int>(values.size());
  int before = -1;
  for (int k = 0; k < rows; ++k) {
    if (lost[k]) continue;
    for (int i = before + 1; i < k; ++i)
      values[i] = before < 0 ? values[k] : between(lost, values, before, k, i, is_smooth);
    before = k;
  }
  for (int i = before + 1; i < rows && before >= 0; ++i) values[i] = values[before];
}

/// Returns the lost rows without gaps of up to `most` rows, which are bridged.
std::vector<bool> without_short_gaps(std::vector<bool> lost, int most) {
  const int rows = static_cast<int>(lost.size());
  for (int k = 0; k < rows;) {
    int end = k;
    while (end < rows && lost[end]) ++end;
    if (end - k <= most) std::fill(lost.begin() + k, lost.begin() + end, false);
    k = end + 1;
  }
  return lost;
}

/// Rows of a log that have all values, and their grid points.
struct PlacedRows {
  std::vector<int> row;
  SampleGrid grid;

  bool suffice() const { return grid.points() >= 2; }
};

PlacedRows placed(const Log& all, double period_s) {
  PlacedRows out;
  std::vector<double> time;
  for (int row = 0; row < all.rows(); ++row) {
    if (!is_complete(all, row) || (!time.empty() && all.time[row] < time.back())) continue;
    out.row.push_back(row);
    time.push_back(all.time[row]);
  }
  std::vector<std::vector<double>> positions(stamps_jitter(time, period_s) ? all.q.size() : 0);
  for (std::size_t j = 0; j < positions.size(); ++j)
    for (const int row : out.row) positions[j].push_back(all.q[j][row]);
  out.grid = sample_grid(time, period_s, row_steps(positions));
  return out;
}

[[noreturn]] void refuse_too_few_rows(const std::string& path) {
  throw Error(ErrorCode::input, path,
              "has fewer than two rows in which each joint has a position, a torque and, if the log records "
              "velocities, a velocity; `faultline inspect` lists which columns lack values");
}

UniformLog on_grid(const Log& all, const PlacedRows& placed) {
  UniformLog out;
  out.start_s = std::abs(placed.grid.start_s) < kSameTime_s ? 0.0 : placed.grid.start_s;
  out.period_s = placed.grid.period_s;
  const int rows = placed.grid.points(), joints = all.joints();
  out.q.setZero(rows, joints);
  out.tau.setZero(rows, joints);
  out.dq.setZero(all.dq.empty() ? 0 : rows, joints);
  out.lost.assign(rows, true);
  for (std::size_t k = 0; k < placed.row.size(); ++k) {
    const int point = placed.grid.point[k], row = placed.row[k];
    if (point < 0) continue;
    out.lost[point] = false;
    for (int j = 0; j < joints; ++j) {
      out.q(point, j) = all.q[j][row];
      out.tau(point, j) = all.tau[j][row];
      if (!all.dq.empty()) out.dq(point, j) = all.dq[j][row];
    }
  }
  for (int j = 0; j < joints; ++j) {
    interpolate(out.lost, true, out.q.col(j));
    interpolate(out.lost, false, out.tau.col(j));
    if (out.dq.rows() > 0) interpolate(out.lost, true, out.dq.col(j));
  }
  out.lost = without_short_gaps(std::move(out.lost), static_cast<int>(kBridged_s / out.period_s));
  out.q_noise = sample_noise(out.q);
  out.dq_noise = sample_noise(out.dq);
  return out;
}

}  // namespace

int UniformLog::first_row(double at_s) const {
  const double least_s = at_s - kSameTime_s;
  int row = static_cast<int>(std::clamp((least_s - start_s) / period_s, 0.0, static_cast<double>(rows())));
  while (row < rows() && time_s(row) < least_s) ++row;
  return row;
}

std::optional<UniformLog> uniform_rows(const Log& all, double period_s) {
  const PlacedRows rows = placed(all, period_s);
  return rows.suffice() ? std::optional(on_grid(all, rows)) : std::nullopt;
}

UniformLog uniform_log(LogSource& log, double period_s) {
  std::optional<UniformLog> out = uniform_rows(read_all(log), period_s);
  if (!out) refuse_too_few_rows(log.identity().path);
  return std::move(*out);
}

MeasuredMotion reading_of(const UniformLog& log, int j) {
  MeasuredMotion out{log.q.col(j), {}};
  if (log.dq.rows() > 0) out.dq = log.dq.col(j);
  return out;
}

UniformLog part_of(const UniformLog& log, int first, int rows) {
  const auto part = [&](const Eigen::MatrixXd& values) -> Eigen::MatrixXd {
    return values.rows() == 0 ? values : Eigen::MatrixXd(values.middleRows(first, rows));
  };
  const auto begin = log.lost.begin() + first;
  return {log.time_s(first), log.period_s,          part(log.q), part(log.dq),
          part(log.tau),     {begin, begin + rows}, log.q_noise, log.dq_noise};
}

UniformLog averaged(UniformLog log, int samples, bool torque_is_held) {
  if (samples < 2) return log;
  const int rows = log.rows() / samples;
  const auto means = [&](const Eigen::MatrixXd& values, bool is_held) {
    Eigen::MatrixXd out(values.rows() == 0 ? 0 : rows, values.cols());
    for (int j = 0; j < out.cols(); ++j)
      for (int k = 0; k < out.rows(); ++k) {
        const int first = k * samples, last = first + samples - 1;
        out(k, j) = values.col(j).segment(first, samples).mean();
        if (is_held) out(k, j) += 0.5 * (values(std::max(first - 1, 0), j) - values(last, j)) / samples;
      }
    return out;
  };
  std::vector<bool> lost(rows, false);
  for (int k = 0; k < rows * samples; ++k)
    if (log.lost[k]) lost[k / samples] = true;
  const double less = 1.0 / std::sqrt(static_cast<double>(samples));
  return {log.time_s(0.5 * (samples - 1)), log.period_s * samples, means(log.q, false), means(log.dq, false),
          means(log.tau, torque_is_held),  std::move(lost),        less * log.q_noise,  less * log.dq_noise};
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
  const double usual = upper_median(std::move(steps));
  std::vector<PlacedRows> rows;
  std::vector<double> periods;
  for (std::size_t k = 0; k < logs.size(); ++k) {
    rows.push_back(placed(read[k], usual));
    if (!rows.back().suffice()) refuse_too_few_rows(logs[k]->identity().path);
    periods.push_back(rows.back().grid.period_s);
  }
  const double period = std::round(upper_median(std::move(periods)) / kPeriodGrid_s) * kPeriodGrid_s;
  std::vector<UniformLog> out;
  for (std::size_t k = 0; k < logs.size(); ++k) {
    out.push_back(on_grid(read[k], rows[k]));
    out.back().period_s = period;
  }
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
    const auto second = [&](int k) {
      return (values(k, j) - values(k - 1, j)) - (values(k - 1, j) - values(k - 2, j));
    };
    for (int k = 4; k < values.rows(); ++k) {
      const double fourth = std::abs((second(k) - second(k - 1)) - (second(k - 1) - second(k - 2)));
      if (fourth > 0.0) size.push_back(fourth);
    }
    noise[j] =
        size.empty() ? 0.0 : upper_median(std::move(size)) / (kNormalMad * std::sqrt(kFourthDifference));
  }
  return noise;
}

RepeatedPositions repeated_positions(const UniformLog& log) {
  RepeatedPositions out{Eigen::VectorXi::Zero(log.joints()), Eigen::VectorXd::Zero(log.joints())};
  for (int j = 0; j < log.joints(); ++j) {
    int run = 0, same = 0;
    for (int k = 1; k < log.rows(); ++k) {
      run = log.q(k, j) == log.q(k - 1, j) ? run + 1 : 0;
      same += run > 0;
      out.longest[j] = std::max(out.longest[j], run);
    }
    out.share[j] = static_cast<double>(same) / (log.rows() - 1);
  }
  return out;
}

}  // namespace faultline
