// SPDX-License-Identifier: MIT
#include "lib/balance/sample_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

constexpr double kLeastError = 0.1, kMostError = 0.35;  // periods: bounds of the error of a stamp (std)
constexpr double kNormalMedian = 0.67;                  // median of |x| of a standard normal x
constexpr double kLostPoint = 4.6;                      // nats of a lost point: one row in a hundred
constexpr double kMostLost = 10.0;                      // nats of a gap, at most: logs are interrupted
constexpr double kMostWrong = 8.0;                      // nats of a stamp error, at most: clocks jump
constexpr double kRowTooMany = 9.2;                     // nats of a surplus row: one in ten thousand
constexpr double kUnlikely = 30.0;                      // nats beyond the best at which a sequence is dropped
constexpr double kDoubtful = 0.25;    // periods: error of a stamp beside a lost point that excludes its row
constexpr int kAround = 2;            // points that are tried on each side of a stamp
constexpr int kStepsAround = 4;       // rows on each side that give the motion of a joint in a period
constexpr double kMostOfStep = 10.0;  // nats of a number of periods by the positions, at most
constexpr double kSpreads = 2.0;      // times the median deviation of the steps around: std of a step
constexpr double kPhaseGain = 0.005;  // gain of the phase for each row: memory of some 200 rows
constexpr double kMostOff = 0.03;     // of a period: a mean step that differs by more includes lost rows
constexpr double kRegular = 0.01, kRegularRate = 1e-3;  // of a period: errors of regular steps and rates

/// Best sequence that ends at one point.
struct Ending {
  int point = 0;
  double cost = 0.0;
  double phase_s = 0.0;  ///< time of point 0, estimated from the last rows
  int before = -1;       ///< ending of the row before
  int row = 0;           ///< last row that has a point
};

/// Estimates the standard deviation of a stamp in periods from the steps between stamps, clipped at a period
/// since rows may be lost. A median would be zero for stamps that are rounded.
double stamp_error(std::span<const double> time, double period_s) {
  double sum = 0.0;
  for (std::size_t k = 1; k < time.size(); ++k) {
    const double off = (time[k] - time[k - 1]) / period_s - 1.0;
    sum += std::min(off * off, 1.0);
  }
  return std::clamp(std::sqrt(0.5 * sum / static_cast<double>(time.size() - 1)), kLeastError, kMostError);
}

/// Returns the nats of `periods` periods between rows `before` and `row` by the motion of the joints.
double cost_of_step(const RowSteps& steps, int before, int row, int periods) {
  double sum = 0.0;
  for (Eigen::Index j = 0; j < steps.position.cols(); ++j) {
    const double moved = steps.position(row, j) - steps.position(before, j), std = steps.std(row, j);
    if (std > 0.0) sum += 0.5 * Eigen::numext::abs2((moved - periods * steps.usual(row, j)) / std);
  }
  return std::min(sum, kMostOfStep);
}

/// Keeps the better of two sequences that end at one point.
void keep_better(const Ending& ending, std::vector<Ending>& endings) {
  const auto known = std::ranges::find(endings, ending.point, &Ending::point);
  if (known == endings.end())
    endings.push_back(ending);
  else if (ending.cost < known->cost)
    *known = ending;
}

/// Returns the endings of row `row`, the next one, which is stamped `time`.
std::vector<Ending> next_endings(const std::vector<Ending>& endings, int row, double time, double period_s,
                                 double error, const RowSteps& steps) {
  const double gain = std::max(kPhaseGain, 1.0 / (row + 1.0));
  std::vector<Ending> out;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < static_cast<int>(endings.size()); ++i) {
    const Ending& e = endings[i];
    const int near = static_cast<int>(std::lround((time - e.phase_s) / period_s));
    for (int point = std::max(near - kAround, e.point + 1); point <= std::max(near + kAround, e.point + 1);
         ++point) {
      const double off_s = time - e.phase_s - period_s * point, z = off_s / (period_s * error);
      const double lost = std::min(kLostPoint * (point - e.point - 1), kMostLost);
      const double cost = e.cost + std::min(0.5 * z * z, kMostWrong) + lost +
                          cost_of_step(steps, e.row, row, point - e.point);
      if (cost > least + kUnlikely) continue;
      least = std::min(least, cost);
      keep_better({point, cost, e.phase_s + gain * off_s, i, row}, out);
    }
    keep_better({e.point, e.cost + kRowTooMany, e.phase_s, i, e.row}, out);
  }
  for (const Ending& e : out) least = std::min(least, e.cost);
  std::erase_if(out, [&](const Ending& e) { return e.cost > least + kUnlikely; });
  return out;
}

/// Sequences of points that end at each row, for one period.
struct Sequences {
  double period_s = 0.0;
  std::vector<std::vector<Ending>> ending;  ///< by row

  /// Returns the index of the best ending of the last row.
  int best() const {
    return static_cast<int>(std::ranges::min_element(ending.back(), {}, &Ending::cost) -
                            ending.back().begin());
  }
  double cost() const { return ending.back()[best()].cost; }
};

Sequences sequences_of(std::span<const double> time, double period_s, const RowSteps& steps) {
  const double error = stamp_error(time, period_s);
  Sequences out{period_s, {{{0, 0.0, time[0], -1, 0}}}};
  for (int row = 1; row < static_cast<int>(time.size()); ++row)
    out.ending.push_back(next_endings(out.ending.back(), row, time[row], period_s, error, steps));
  return out;
}

/// Returns whether every stamp clearly belongs to the point after that of the stamp before.
bool are_regular(std::span<const double> time, double period_s) {
  for (std::size_t k = 1; k < time.size(); ++k)
    if (!(std::abs(time[k] - time[k - 1] - period_s) < kRegular * period_s)) return false;
  const double steps = static_cast<double>(time.size() - 1);
  return std::abs(time.back() - time.front() - steps * period_s) < kRegularRate * steps * period_s;
}

/// Returns the points without those of rows beside a lost point whose stamps lie about as near to it as to
/// their own. `off`: stamp minus time of its point, in periods.
std::vector<int> without_doubtful(std::vector<int> point, const std::vector<double>& off) {
  int before = -1;  // last point of a row that is kept
  for (std::size_t k = 0; k < point.size(); ++k) {
    if (point[k] < 0) continue;
    if (point[k] > before + 1 && off[k] < -kDoubtful)
      point[k] = -1;
    else
      before = point[k];
  }
  int after = before + 1;
  for (std::size_t k = point.size(); k-- > 0;) {
    if (point[k] < 0) continue;
    if (point[k] < after - 1 && off[k] > kDoubtful)
      point[k] = -1;
    else
      after = point[k];
  }
  return point;
}

/// Fits start and period by least squares of the stamps over the points.
SampleGrid with_line(SampleGrid grid, std::span<const double> time, double period_s) {
  double rows = 0.0, point = 0.0, off = 0.0;
  for (std::size_t k = 0; k < time.size(); ++k) {
    if (grid.point[k] < 0) continue;
    rows += 1.0;
    point += grid.point[k];
    off += time[k] - time[0] - period_s * grid.point[k];
  }
  point /= rows;
  off /= rows;
  double square = 0.0, product = 0.0;
  for (std::size_t k = 0; k < time.size(); ++k) {
    if (grid.point[k] < 0) continue;
    const double x = grid.point[k] - point;
    square += x * x;
    product += x * (time[k] - time[0] - period_s * grid.point[k] - off);
  }
  const double slope = square > 0.0 ? product / square : 0.0;
  grid.period_s = period_s + slope;
  grid.start_s = time[0] + off - slope * point;
  return grid;
}

}  // namespace

int SampleGrid::points() const {
  int most = -1;
  for (const int p : point) most = std::max(most, p);
  return most + 1;
}

RowSteps row_steps(const std::vector<std::vector<double>>& positions) {
  const auto joints = static_cast<int>(positions.size());
  const int rows = joints > 0 ? static_cast<int>(positions[0].size()) : 0;
  RowSteps out;
  out.position = out.usual = out.std = Eigen::MatrixXd::Zero(rows, joints);
  std::vector<double> step(static_cast<std::size_t>(std::max(rows, 1)), 0.0), around, off;
  for (int j = 0; j < joints; ++j) {
    for (int k = 0; k < rows; ++k) out.position(k, j) = positions[j][k];
    for (int k = 1; k < rows; ++k) step[k] = positions[j][k] - positions[j][k - 1];
    off.clear();
    for (int k = 1; k < rows; ++k) {
      around.assign(step.begin() + std::max(1, k - kStepsAround),
                    step.begin() + std::min(rows, k + kStepsAround + 1));
      const double usual = out.usual(k, j) = upper_median_of(around);
      for (double& s : around) s = std::abs(s - usual);
      out.std(k, j) = kSpreads * upper_median_of(around);  // a joint speeds up or slows down
      if (const double d = std::abs(step[k] - usual); d > 0.0) off.push_back(d);
    }
    if (off.empty()) continue;
    const double noise = upper_median_of(off) / kNormalMedian;
    for (int k = 1; k < rows; ++k) out.std(k, j) = elementary::hypot(out.std(k, j), noise);
  }
  return out;
}

bool stamps_jitter(std::span<const double> time, double period_s) {
  return time.size() > 1 && stamp_error(time, period_s) > kLeastError;
}

SampleGrid sample_grid(std::span<const double> time, double period_s, const RowSteps& steps) {
  SampleGrid grid{0.0, period_s, std::vector<int>(time.size(), -1)};
  if (time.size() < 2) return grid;
  if (are_regular(time, period_s)) {
    std::iota(grid.point.begin(), grid.point.end(), 0);
    return with_line(std::move(grid), time, period_s);
  }
  Sequences all = sequences_of(time, period_s, steps);
  // The usual step of stamps with jitter differs from the period by some tenths of a per cent. The mean step
  // is the period if no row is lost.
  const double mean_s = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  const double off_rate = std::abs(mean_s / period_s - 1.0);
  if (off_rate > kRegularRate && off_rate < kMostOff)
    if (Sequences by_mean = sequences_of(time, mean_s, steps); by_mean.cost() < all.cost())
      all = std::move(by_mean);
  std::vector<double> off(time.size(), 0.0);
  int at = all.best();
  for (std::size_t k = time.size(); k-- > 0;) {
    const Ending& e = all.ending[k][at];
    if (e.row == static_cast<int>(k)) grid.point[k] = e.point;
    off[k] = (time[k] - e.phase_s) / all.period_s - e.point;
    at = e.before;
  }
  grid.point = without_doubtful(std::move(grid.point), off);
  return with_line(std::move(grid), time, all.period_s);
}

}  // namespace faultline
