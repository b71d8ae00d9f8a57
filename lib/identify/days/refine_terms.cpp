// SPDX-License-Identifier: MIT
#include "lib/identify/days/refine_terms.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>

#include "lib/core/elementary/elementary.hpp"
#include "lib/identify/days/ripple_search.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array kWidthFactors{.6, .75, .9, 1., 1.12, 1.3, 1.6};
constexpr double kStiff = 1e-5;        // rad per N m or m per N: a gear that gives way less is rigid
constexpr double kWidthRidge = 1e-12;  // for joints that rest

VectorXd saturated_by(const VectorXd& speed, double width) {
  return speed.unaryExpr([width](double v) { return elementary::tanh(v / width); });
}

/// Squares of joint `j` that remain of a day when its friction has this width and level and slope are fitted
/// anew.
double left_with_width(const HealthyDay& day, const BalanceModel& m, int j, double width) {
  const std::vector<bool> near = rows_near_change(day, m);
  std::vector<int> rows;
  for (int k = 0; k < day.rows.rows(); ++k)
    if (!day.rows.lost[k] && (near.empty() || !near[k])) rows.push_back(k);
  const VectorXd all = left_over(day, m.theta).col(j), left = all(rows), speed = day.rows.dq.col(j)(rows);
  const VectorXd y = left + m.theta[m.layout().coulomb(j)] * saturated_by(speed, m.setting.friction_width[j]);
  MatrixXd x(speed.size(), 3);
  x << speed, saturated_by(speed, width), VectorXd::Ones(speed.size());
  const MatrixXd square = x.transpose() * x + kWidthRidge * MatrixXd::Identity(3, 3);
  const VectorXd product = x.transpose() * y;
  return y.squaredNorm() - product.dot(square.ldlt().solve(product));
}

/// Where the parabola through three points, the middle one the lowest, is lowest.
double lowest_of_parabola(const std::array<double, 3>& x, const std::array<double, 3>& y) {
  const double a = (x[1] - x[0]) * (y[1] - y[2]), b = (x[1] - x[2]) * (y[1] - y[0]);
  return a == b ? x[1] : x[1] - 0.5 * ((x[1] - x[0]) * a - (x[1] - x[2]) * b) / (a - b);
}

}  // namespace

DayDraft with_refined_widths(DayDraft draft) {
  BalanceModel& m = draft.model;
  const int last = static_cast<int>(kWidthFactors.size()) - 1;
  for (int j = 0; j < m.joints(); ++j) {
    std::array<double, kWidthFactors.size()> left{};
    for (int k = 0; k <= last; ++k)
      for (const HealthyDay& day : draft.days)
        left[k] += left_with_width(day, m, j, kWidthFactors[k] * m.setting.friction_width[j]);
    const int best = static_cast<int>(std::min_element(left.begin(), left.end()) - left.begin());
    const auto log_factor = [](int k) { return elementary::log(kWidthFactors[k]); };
    double at = log_factor(best);
    if (best > 0 && best < last)
      at = lowest_of_parabola({log_factor(best - 1), at, log_factor(best + 1)},
                              {left[best - 1], left[best], left[best + 1]});
    m.setting.friction_width[j] *= elementary::exp(at);
  }
  return draft;
}

BalanceModel with_compliance(BalanceModel m) {
  for (int j = 0; j < m.joints(); ++j) {
    const double k = m.theta[m.layout().spring(j)];
    m.setting.compliance[j] = k > kStiff ? k : 0.0;
  }
  return m;
}

DayDraft with_ripples(DayDraft draft) {
  BalanceModel& m = draft.model;
  std::vector<LeftOver> left;
  for (const HealthyDay& day : draft.days)
    left.push_back({&day.rows, left_over(day, m.theta), {}, rows_near_change(day, m)});
  m.setting.ripples = find_ripples_in_rows(left, m.setting, m.q_high - m.q_low);
  const VectorXd before = m.theta;
  m.theta.setZero(m.layout().count());
  m.theta.head(before.size()) = before;
  draft.used.resize(m.theta.size(), true);
  return draft;
}

DayDraft with_rotors(DayDraft draft, bool are_looked_for) {
  const BalanceModel& m = draft.model;
  for (int p = 0; p < m.rigid.base(); ++p) {
    if (!is_rotor(m.rigid, p)) continue;
    draft.refused[p] = draft.refused[p] || m.theta[p] < 0.0;
    draft.used[p] = are_looked_for && !draft.refused[p];
  }
  return draft;
}

}  // namespace faultline
