// SPDX-License-Identifier: MIT
#include "lib/explain/search/standstill.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lib/balance/smoothing.hpp"
#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

using Eigen::VectorXd;

constexpr double kYields = 2e-2;  // of a joint's range: a lock yields less to the torque
constexpr double kLeftOfYielding =
    0.5;                          // of the deflection (rms): motion that the torque does not explain, at most
constexpr double kRest_s = 0.15;  // at the end of a log that gives the position of a joint at rest
constexpr int kRestRows = 8;      // rows after an onset that give the position of a locked joint
constexpr int kMovesRows = 3;     // rows in succession that show that it moves again
constexpr double kHalts_s = 0.1;  // s beside the begin or end of a standstill in which the joint still moves
constexpr double kSurelyStands = 8.0;  // standard deviations of a position within which a joint stands still
constexpr double kLockLags = 1.0;      // share of a lock's deflection: it settles later than its torque
constexpr double kSpringDoubt = 0.3;   // share of a spring's deflection: error of its model
constexpr double kLeastTolerance = 1e-5;  // rad or m that a joint may move while it stands
constexpr double kLeastNoise = 1e-6;      // rad or m: of a position

/// Rows in which a joint stands still, from `begin` to before `end`.
struct StillRows {
  int begin = 0, end = 0;
};

/// Position of a joint without the deflection of its spring, and its apparent motion while it stands still.
struct Standstill {
  VectorXd place;  ///< by row, rad or m
  double tolerance = 0.0;
};

/// Returns the standard deviation of a joint's position in a row.
double noise_of(const LogFit& fit, int j) {
  const BalanceModel& m = fit.model();
  return std::max(m.q_noise[j] * fit.loudness()[j], kLeastNoise) *
         gaussian_kernel(m.setting.kernel_s, m.setting.period_s).norm();
}

Standstill standstill(const LogFit& fit, int j, const Yielding& yielding) {
  const VectorXd deflection = yielding.compliance * yielding.load;
  return {fit.rows().q.col(j) - deflection,
          kSurelyStands * noise_of(fit, j) + kLeastTolerance +
              yielding.doubt * (deflection.maxCoeff() - deflection.minCoeff())};
}

/// The same with a tolerance that covers the yielding of any lock.
Standstill roughly_standing(const LogFit& fit, int j) {
  Standstill out = standstill(fit, j, yielding_of_gear(fit, j));
  out.tolerance = std::max(out.tolerance, kYields * (fit.model().q_high[j] - fit.model().q_low[j]));
  return out;
}

/// Returns the standstill with the compliance of a lock that lasts for these rows.
Standstill locked_within(const LogFit& fit, int j, StillRows rows) {
  const int halts = static_cast<int>(std::lround(kHalts_s / fit.model().setting.row_s()));
  rows.begin += halts;
  rows.end -= rows.end < fit.count() ? halts : 0;
  std::vector<int> within(static_cast<std::size_t>(std::max(0, rows.end - rows.begin)));
  std::iota(within.begin(), within.end(), rows.begin);
  return standstill(fit, j, yielding_of_lock(fit, j, within));
}

int still_since(const LogFit& fit, const Standstill& stands) {
  const int tail = std::min(fit.count(), static_cast<int>(kRest_s / fit.model().setting.row_s()) + 3);
  const double rest =
      upper_median({stands.place.data() + fit.count() - tail, stands.place.data() + fit.count()});
  int since = fit.count();
  while (since > 0 && std::abs(stands.place[since - 1] - rest) <= stands.tolerance) --since;
  return since;
}

/// Returns the first row at or after `first` from which the joint moves; the number of rows if it never does.
int moves_at(const LogFit& fit, int j, const Standstill& stands, int first) {
  const VectorXd q = fit.rows().q.col(j);
  const int rest_rows = std::min(kRestRows, fit.count() - first);
  const auto rest_of = [&](const VectorXd& values) {
    return upper_median({values.data() + first, values.data() + first + rest_rows});
  };
  const double rest = rest_of(stands.place), q_rest = rest_of(q);
  int moving = 0;
  for (int k = first; k < fit.count(); ++k) {
    const double off = std::min(std::abs(stands.place[k] - rest), std::abs(q[k] - q_rest));
    moving = off > stands.tolerance ? moving + 1 : 0;
    if (moving == kMovesRows) return k - kMovesRows + 1;
  }
  return fit.count();
}

}  // namespace

Yielding yielding_of_gear(const LogFit& fit, int j) {
  return {fit.model().compliance(j), fit.rows().torque.col(j), kSpringDoubt};
}

Yielding yielding_of_lock(const LogFit& fit, int j, const std::vector<int>& rows) {
  Yielding gear = yielding_of_gear(fit, j);
  if (rows.size() < 2) return gear;
  Yielding lock{0.0, unstacked(fit.residual(), fit.joints()).col(j), kLockLags};
  const VectorXd load = lock.load(rows), q = fit.rows().q.col(j)(rows);
  const VectorXd t = load.array() - load.mean(), p = q.array() - q.mean();
  lock.compliance = t.dot(p) / std::max(t.squaredNorm(), 1e-12);
  const VectorXd deflection = lock.compliance * t;
  const double share = std::sqrt(1.0 / static_cast<double>(rows.size())),
               left = share * (p - deflection).norm();
  const bool is_possible =
      deflection.cwiseAbs().maxCoeff() < kYields * (fit.model().q_high[j] - fit.model().q_low[j]) &&
      left < kLeftOfYielding * share * deflection.norm() + kSurelyStands * noise_of(fit, j);
  return is_possible && lock.compliance > gear.compliance ? lock : gear;
}

int still_since(const LogFit& fit, int j) {
  const int roughly = still_since(fit, roughly_standing(fit, j));
  return still_since(fit, locked_within(fit, j, {roughly, fit.count()}));
}

std::optional<double> moves_from(const LogFit& fit, int j, double from_s) {
  const int first = fit.first_row(from_s);
  if (fit.count() - first < kMovesRows) return std::nullopt;
  const int roughly = moves_at(fit, j, roughly_standing(fit, j), first);
  const int row = moves_at(fit, j, locked_within(fit, j, {first, roughly}), first);
  return row < fit.count() ? std::optional(fit.time_s()[row]) : std::nullopt;
}

}  // namespace faultline
