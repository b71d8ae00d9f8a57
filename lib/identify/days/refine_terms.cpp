// SPDX-License-Identifier: MIT
#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "lib/balance/ripples.hpp"
#include "lib/core/elementary/elementary.hpp"
#include "lib/identify/days/healthy_day.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Factors on a friction width, tried in turn; a parabola through the best and its neighbours gives the width.
constexpr std::array kWidthFactors{.6, .75, .9, 1., 1.12, 1.3, 1.6};
constexpr double kClearSpring = 20.0;   // nats, from rows that are not quite independent
constexpr double kLeastBySpring = 0.2;  // share of the squared residual: friction at reversals imitates less
constexpr double kWidthRidge = 1e-12;   // for joints at rest

/// Slower ripples look like gravity and inertia. Refined rates would fit a faulty log among the healthy ones
/// so well that it is not doubted any more.
constexpr RippleBounds kUsualRipples{
    .form = RippleForm::constant_and_by_torque, .least_explained = 0.05, .least_waves = 20.0};

/// Returns the rows of a day that determine the friction of joint `j`: neither lost nor near a change of the
/// work piece, and the joint is not held by static friction.
std::vector<int> rows_of_friction(const HealthyDay& day, const BalanceModel& m, int j) {
  const std::vector<bool> near = rows_near_change(day, m);
  std::vector<int> rows;
  for (int k = 0; k < day.rows.rows(); ++k)
    if (!day.rows.lost[k] && !day.rows.is_silent(k, j) && (near.empty() || !near[k])) rows.push_back(k);
  return rows;
}

/// Returns the squared residual of joint `j` on a day with the friction width and the spring of `setting`,
/// after a new fit of level and slope of the friction.
double residual_with(const HealthyDay& day, const BalanceModel& m, int j, const RowSetting& setting) {
  const ColumnLayout at = m.layout();
  const MatrixXd& column = day.rows.column[j];
  VectorXd y = left_over(day, m.theta).col(j);
  for (const int p : {at.viscous(j), at.coulomb(j)}) y += m.theta[p] * column.col(p);
  y += (m.theta[at.spring(j)] - setting.compliance[j]) * column.col(at.spring(j));
  MatrixXd x(y.size(), 3);
  x << friction_columns(day.log, setting, j), VectorXd::Ones(y.size());
  const std::vector<int> rows = rows_of_friction(day, m, j);
  x = x(rows, Eigen::all).eval();
  y = y(rows).eval();
  const MatrixXd square = x.transpose() * x + kWidthRidge * MatrixXd::Identity(3, 3);
  const VectorXd product = x.transpose() * y;
  return y.squaredNorm() - product.dot(square.ldlt().solve(product));
}

double residual_with(const DayDraft& draft, int j, const RowSetting& setting) {
  double out = 0.0;
  for (const HealthyDay& day : draft.days) out += residual_with(day, draft.model, j, setting);
  return out;
}

/// Returns the x at which the parabola through three points, the middle one the lowest, is lowest.
double lowest_of_parabola(const std::array<double, 3>& x, const std::array<double, 3>& y) {
  const double a = (x[1] - x[0]) * (y[1] - y[2]), b = (x[1] - x[2]) * (y[1] - y[0]);
  return a == b ? x[1] : x[1] - 0.5 * ((x[1] - x[0]) * a - (x[1] - x[2]) * b) / (a - b);
}

RippleRows rows_of_joint(const DayDraft& draft, int j) {
  RippleRows out;
  for (const HealthyDay& day : draft.days) {
    const MatrixXd left = left_over(day, draft.model.theta);
    for (const int k : rows_of_friction(day, draft.model, j))
      out.add(day.rows.q(k, j), day.rows.dq(k, j), day.rows.torque(k, j), left(k, j));
  }
  return out;
}

}  // namespace

DayDraft with_refined_widths(DayDraft draft) {
  BalanceModel& m = draft.model;
  const int last = static_cast<int>(kWidthFactors.size()) - 1;
  for (int j = 0; j < m.joints(); ++j) {
    std::array<double, kWidthFactors.size()> left{};
    for (int k = 0; k <= last; ++k) {
      RowSetting setting = m.setting;
      setting.friction_width[j] *= kWidthFactors[k];
      left[k] = residual_with(draft, j, setting);
    }
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

DayDraft with_chosen_springs(DayDraft draft) {
  const BalanceModel& m = draft.model;
  for (int j = 0; j < m.joints(); ++j) {
    double rows = 0.0;
    for (const HealthyDay& day : draft.days) rows += static_cast<double>(rows_of_friction(day, m, j).size());
    const int spring = m.layout().spring(j);
    const auto left = [&](double compliance) {
      RowSetting setting = m.setting;
      setting.compliance[j] = compliance;
      return residual_with(draft, j, setting);
    };
    const double rigid = left(0.0), elastic = left(m.compliance(j));
    draft.used[spring] = draft.used[spring] && m.compliance(j) > 0.0 &&
                         elastic < (1.0 - kLeastBySpring) * rigid &&
                         0.5 * rows * elementary::log(rigid / elastic) > kClearSpring;
  }
  return draft;
}

BalanceModel with_compliance(BalanceModel m) {
  for (int j = 0; j < m.joints(); ++j) m.setting.compliance[j] = m.compliance(j);
  return m;
}

DayDraft with_ripples(DayDraft draft) {
  BalanceModel& m = draft.model;
  m.setting.ripples.clear();
  for (int j = 0; j < m.joints(); ++j)
    if (const auto rate = strongest_ripple(rows_of_joint(draft, j), m.setting.kernel_s,
                                           m.q_high[j] - m.q_low[j], kUsualRipples))
      m.setting.ripples.push_back({Joint::at(j), *rate});
  const VectorXd before = m.theta;
  m.theta.setZero(m.layout().count());
  m.theta.head(before.size()) = before;
  draft.used.resize(m.theta.size(), true);
  return draft;
}

std::optional<int> column_of(const ExtraTerm& term, const ColumnLayout& layout) {
  if (term.kind == ExtraKind::load_friction) return layout.load(term.joint.index());
  if (term.kind == ExtraKind::shared_inertia) return layout.drive(term.index);
  if (term.kind == ExtraKind::shared_viscous) return layout.drive(term.index) + 1;
  if (term.kind == ExtraKind::shared_coulomb) return layout.drive(term.index) + 2;
  return std::nullopt;
}

DayDraft without_impossible_terms(DayDraft draft) {
  for (int p = 0; p < draft.model.rigid.base(); ++p)
    if (is_rotor(draft.model.rigid, p) && draft.model.theta[p] < 0.0) draft.used[p] = false;
  for (const ExtraTerm& term : draft.extra) {
    const std::optional<int> column = column_of(term, draft.model.layout());
    if (column && !is_possible(term.kind, draft.model.theta[*column])) draft.used[*column] = false;
  }
  return draft;
}

}  // namespace faultline
