// SPDX-License-Identifier: MIT
#include "lib/diagnose/question/find_column_change.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/statistics.hpp"
#include "lib/diagnose/question/torque_balance.hpp"
#include "lib/plausibility/column_interpretation.hpp"

namespace faultline {
namespace {

constexpr int kChangeRows = 4000;          // rows that are tested on either side of the change
constexpr double kAtOnset_s = 0.1;         // after the onset, which is an estimate: not tested
constexpr double kChangeExplains = 0.35;   // median misfit of a joint's blocks, up to which it is explained
constexpr double kTimesWorse = 3.0;        // ratio to the misfit before the change, or of other columns
constexpr double kMovesAtAll = 0.2;        // share of the fastest velocity: slower rows do not count
constexpr double kOneUnit = 1.4;           // ratio of two velocities up to which they have one unit
constexpr std::size_t kFewestRatios = 20;  // moving rows: with fewer ratios a joint is not tested
constexpr double kNothingLeft = 0.02;      // least misfit: below it, all interpretations are as good

struct Sides {
  Log before, behind;
};

Sides sides_of(LogSource& log, double onset_s) {
  Sides out;
  log.rewind();
  for (Log segment; out.behind.rows() < kChangeRows && log.next(segment);) {
    const auto onset = std::lower_bound(segment.time.begin(), segment.time.end(), onset_s);
    const auto first = std::upper_bound(onset, segment.time.end(), onset_s + kAtOnset_s);
    append(out.before, slice(segment, 0, static_cast<int>(onset - segment.time.begin())));
    append(out.behind, slice(segment, static_cast<int>(first - segment.time.begin()), segment.rows()));
    if (out.before.rows() > kChangeRows)
      out.before = slice(out.before, out.before.rows() - kChangeRows, out.before.rows());
  }
  log.rewind();
  if (out.behind.rows() > kChangeRows) out.behind = slice(out.behind, 0, kChangeRows);
  return out;
}

/// Median misfit of each joint's blocks, at least kNothingLeft; NaN for a joint without a usable block.
std::vector<double> median_misfits(const Log& rows, const KnownRobot& robot) {
  std::vector<double> left(robot.joints(), std::nan(""));
  if (rows.rows() == 0) return left;
  const std::vector<JointBalance> balance = torque_balance(rows, robot);
  for (int j = 0; j < robot.joints(); ++j) {
    if (!(robot.usual.torque_scale[j] > 0.0) || balance[j].velocity_factor != 1.0) continue;
    const std::vector<double> blocks = misfits(balance[j], robot.usual.torque_scale[j]);
    if (!blocks.empty()) left[j] = std::max(upper_median(blocks), kNothingLeft);
  }
  return left;
}

/// Whether the velocity of each joint is the derivative of its position, by the median of their ratios:
/// single jumps of a position do not count.
bool velocity_fits_position(const Log& rows) {
  for (std::size_t j = 0; j < rows.dq.size(); ++j) {
    const std::vector<double>&q = rows.q[j], &dq = rows.dq[j];
    double fastest = 0.0;
    for (const double v : dq)
      if (std::isfinite(v)) fastest = std::max(fastest, std::abs(v));
    std::vector<double> ratio;
    for (int k = 1; k + 1 < rows.rows(); ++k) {
      const double slope = (q[k + 1] - q[k - 1]) / (rows.time[k + 1] - rows.time[k - 1]);
      if (std::isfinite(slope) && slope != 0.0 && std::abs(dq[k]) > kMovesAtAll * fastest)
        ratio.push_back(dq[k] / slope);
    }
    if (ratio.size() < kFewestRatios) continue;
    const double median = upper_median(ratio);
    if (median < 1.0 / kOneUnit || median > kOneUnit) return false;
  }
  return true;
}

/// Whether the interpretation explains every joint that was explained before the change, and one of them far
/// better than the plain columns do. Arguments: misfits by joint (median_misfits()).
bool explains(const std::vector<double>& reading, const std::vector<double>& plain,
              const std::vector<double>& before) {
  bool better = false, any = false;
  for (std::size_t j = 0; j < reading.size(); ++j) {
    if (!std::isfinite(before[j]) || before[j] > kChangeExplains) continue;
    const bool is_determined = std::isfinite(reading[j]);
    if (is_determined && reading[j] > std::min(kChangeExplains, kTimesWorse * before[j])) return false;
    if (!is_determined && std::isfinite(plain[j])) return false;
    any = any || is_determined;
    better = better || (is_determined && (!std::isfinite(plain[j]) || plain[j] > kTimesWorse * reading[j]));
  }
  return any && better;
}

double sum_of_logs(const std::vector<double>& left) {
  double sum = 0.0;
  for (const double one : left)
    if (std::isfinite(one)) sum += elementary::log(one);
  return sum;
}

}  // namespace

std::optional<ColumnChange> find_column_change(LogSource& log, const KnownRobot& robot, double onset_s) {
  const Sides sides = sides_of(log, onset_s);
  if (sides.before.rows() == 0 || sides.behind.rows() == 0 || sides.behind.tau.empty()) return {};
  const std::vector<double> before = median_misfits(sides.before, robot),
                            plain = median_misfits(sides.behind, robot);
  std::vector<ColumnInterpretation> readings = common_interpretations(robot.chain());
  for (ColumnInterpretation& reading : column_interpretations(robot.chain()))
    readings.push_back(std::move(reading));
  std::optional<ColumnChange> best;
  double least = 0.0;
  for (const ColumnInterpretation& reading : readings) {
    Log rows = sides.behind;
    reading.apply(rows);
    const std::vector<double> left = median_misfits(rows, robot);
    const double sum = sum_of_logs(left);
    if (!explains(left, plain, before) || (best && sum >= least) || !velocity_fits_position(rows)) continue;
    least = sum;
    best = {sides.before.first_row + sides.before.rows() + 1, onset_s, reading.what};
  }
  return best;
}

}  // namespace faultline
