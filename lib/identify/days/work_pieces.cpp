// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "lib/core/statistics.hpp"
#include "lib/identify/days/draft_rows.hpp"
#include "lib/identify/days/healthy_day.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kPieceRows = 20;       // rows over which a mass is estimated
constexpr int kFewestWindows = 6;    // of a day: fewer cannot show two groups of masses
constexpr double kPieceShare = 0.1;  // of the carried mass: least mass of a work piece
// Least step between the groups, in standard deviations within one; a single group, split, has 2.2.
constexpr double kClearStep = 4.0;
constexpr double kAlikeDays = 0.5;  // of the step: largest scatter of the steps between days
constexpr double kWeight = 9.81;    // N: weight of 1 kg
// Standard deviation of the rows on a path: rough at first, then by the noise, kLeastPathShare at least.
constexpr double kRoughShare = 0.25, kLeastPathShare = 0.02,
                 kNoiseShare = 0.3;        // of the work piece's weight, and of the residual
constexpr double kNormalSpread = 1.4826;   // standard deviation over the median of |x|
constexpr double kCountsForNothing = 1e9;  // N m or N: standard deviation of joints that carry no weight
constexpr double kNoSpread = 1e-12;        // kg^2: keeps the ratio finite if all masses are alike

/// Two groups of masses, kg: median of the lighter one, step to the other, and the step divided by the spread
/// within the groups.
struct Groups {
  double low = 0.0, step = 0.0, ratio = 0.0;
};

/// Returns the mass at the tip, kg, that best explains each stretch of kPieceRows rows, without joints that
/// static friction holds.
std::vector<double> masses_of(const HealthyDay& day, const BalanceModel& m, const VectorXd& theta) {
  const MatrixXd left = day.rows.torque - torque_of(day.rows, theta);
  std::vector<double> out;
  for (int w = 0; w < day.rows.rows() / kPieceRows; ++w) {
    double product = 0.0, square = 0.0;
    int rows = 0;
    for (int j = 0; j < m.joints(); ++j) {
      if (!carries_weight(m.rigid, j)) continue;
      for (int k = w * kPieceRows; k < (w + 1) * kPieceRows; ++k) {
        if (day.rows.is_silent(k, j)) continue;
        product += day.tip(k, j) * left(k, j);
        square += day.tip(k, j) * day.tip(k, j);
        ++rows;
      }
    }
    if (2 * rows >= kPieceRows) out.push_back(product / square);
  }
  return out;
}

Groups groups_of(std::vector<double> masses) {
  std::sort(masses.begin(), masses.end());
  const Eigen::Map<const VectorXd> sorted(masses.data(), static_cast<Eigen::Index>(masses.size()));
  const auto spread = [](const auto& v) { return (v.array() - v.mean()).square().sum(); };
  double least = 0.0;
  int split = 0;
  for (int k = 2; k + 2 < sorted.size(); ++k) {
    const double sum = spread(sorted.head(k)) + spread(sorted.tail(sorted.size() - k));
    if (split == 0 || sum < least) least = sum, split = k;
  }
  Groups out;
  out.low = upper_median({masses.begin(), masses.begin() + split});
  out.step = upper_median({masses.begin() + split, masses.end()}) - out.low;
  out.ratio = out.step / std::sqrt(least / static_cast<double>(masses.size()) + kNoSpread);
  return out;
}

/// Returns the mass that the joints along gravity carry, kg.
double carried_kg(const DayDraft& draft) {
  double product = 0.0, square = 0.0;
  for (const HealthyDay& day : draft.days) {
    const MatrixXd torque = torque_of(day.rows, draft.model.theta);
    for (int j = 0; j < draft.model.joints(); ++j) {
      if (!carries_weight(draft.model.rigid, j)) continue;
      product += torque.col(j).dot(day.tip.col(j));
      square += day.tip.col(j).squaredNorm();
    }
  }
  return square > 0.0 ? std::abs(product / square) : 0.0;
}

}  // namespace

DayDraft with_first_piece(DayDraft draft) {
  std::vector<double> low, step, ratio;
  std::vector<BalanceRows> rows;
  for (const HealthyDay& day : draft.days) rows.push_back(without_balances(day.rows, day.rows.silent));
  const VectorXd theta = plain_fit(rows, draft.model.layout(), draft.used, draft.model.torque_rms);
  for (const HealthyDay& day : draft.days) {
    std::vector<double> masses = masses_of(day, draft.model, theta);
    if (masses.size() < kFewestWindows) return draft;
    const Groups groups = groups_of(std::move(masses));
    low.push_back(groups.low);
    step.push_back(groups.step);
    ratio.push_back(groups.ratio);
  }
  const Eigen::Map<const VectorXd> steps(step.data(), static_cast<Eigen::Index>(step.size()));
  const double usual = upper_median(step),
               scatter = std::sqrt((steps.array() - steps.mean()).square().mean());
  const bool stands_out = upper_median(ratio) > kClearStep && scatter < kAlikeDays * usual &&
                          usual > kPieceShare * carried_kg(draft);
  if (!stands_out) return draft;
  BalanceModel& m = draft.model;
  m.piece_kg = usual;
  m.theta.head(m.rigid.base()) += upper_median(low) * m.payload.col(m.joints() - 1);
  return draft;
}

DayDraft with_piece_paths(DayDraft draft, bool is_rough) {
  BalanceModel& m = draft.model;
  if (m.piece_kg <= 0.0) return draft;
  std::vector<double> size;
  std::vector<MatrixXd> left;
  for (const HealthyDay& day : draft.days) {
    left.push_back(day.rows.torque - torque_of(day.rows, m.theta) - effect_torque(day));
    for (int k = 0; k < day.rows.rows(); ++k)
      if (!day.rows.is_silent(k, m.joints() - 1)) size.push_back(std::abs(left.back()(k, m.joints() - 1)));
  }
  const double weight = m.piece_kg * kWeight, noise = kNormalSpread * upper_median(std::move(size));
  const double std =
      is_rough ? kRoughShare * weight : std::max(kNoiseShare * noise, kLeastPathShare * weight);
  double product = 0.0, square = 0.0;
  for (std::size_t d = 0; d < draft.days.size(); ++d) {
    HealthyDay& day = draft.days[d];
    MatrixXd deviation = MatrixXd::Constant(day.rows.rows(), m.joints(), kCountsForNothing);
    for (int j = 0; j < m.joints(); ++j)
      for (int k = 0; k < day.rows.rows(); ++k)
        if (carries_weight(m.rigid, j) && !day.rows.is_silent(k, j)) deviation(k, j) = std;
    day.path = piece_path(left[d], m.piece_kg * day.tip, deviation);
    day.piece.setZero();
    for (int k = 0; k < day.rows.rows(); ++k) {
      if (day.path[k] == 0) continue;
      day.piece.row(k) = m.piece_kg * day.tip.row(k);
      for (int j = 0; j < m.joints(); ++j) {
        if (!carries_weight(m.rigid, j) || day.rows.is_silent(k, j)) continue;
        product += day.tip(k, j) * left[d](k, j);
        square += day.tip(k, j) * day.tip(k, j);
      }
    }
  }
  if (square > 0.0) m.piece_kg = product / square;
  return draft;
}

}  // namespace faultline
