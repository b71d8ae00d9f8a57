// SPDX-License-Identifier: MIT
#include "lib/explain/day/day_ripples.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lib/balance/ripples.hpp"
#include "lib/explain/day/own_noise.hpp"
#include "lib/explain/free_form.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostRounds = 5;        // each refines the ripples found so far, and may find more
constexpr double kPhaseStep = 0.02;   // rad at an end of the joint's range: of a difference quotient
constexpr double kFarResidual = 3.0;  // standard deviations: a later row has half of its weight
constexpr double kNoRipple = 3.0;     // times the rms of the calm rows: a larger residual is no ripple
constexpr double kSamePhase = 0.01;   // rad: a ripple that moves less is settled
constexpr double kMostly = 0.5;       // least share of the squared residual that a ripple explains
constexpr double kLeastWaves = 20.0, kLeastWavesOfSlide = 10.0;  // radians over the range of the joint
constexpr Eigen::Index kFewestCalm = 60;  // calm rows: with fewer a ripple resembles other errors
constexpr int kRefinements = 12;          // of the rate: they leave .3 % of a step of the search
constexpr double kRippleStd = 0.1;        // share of the torque rms: prior of sine and cosine

/// Returns the index of ripple `r` of the day among all ripples of the model.
std::size_t index_of(const BalanceModel& m, int r) { return m.setting.ripples.size() - m.ripples_of_day + r; }

/// Residual torque of one joint beside the effects of the day, and the rows that count: the calm ones, and
/// later ones with residuals up to a bound.
struct RippledJoint {
  VectorXd torque;  ///< by row, N m or N
  VectorXd counts;  ///< 1 or 0
};

RippledJoint rippled_joint(const LogFit& fit, const CalmRows& calm, int j, double most) {
  const Eigen::Index rows = fit.count(), calm_rows = calm.torque.rows();
  const JointMask has_weight = rows_with_weight(fit);
  RippledJoint out{(torque_without_piece(fit) - fit.day_torque(calm.day)).segment(j * rows, rows),
                   calm.counts.col(j).cast<double>()};
  out.counts.conservativeResize(rows);
  for (Eigen::Index k = calm_rows; k < rows; ++k)
    out.counts[k] = std::abs(out.torque[k]) < most && has_weight(k, j) ? 1.0 : 0.0;
  return out;
}

/// Returns the rate of the ripple that explains most of the residual of joint `joint`, if there is one.
std::optional<double> ripple_of(const LogFit& fit, const CalmRows& calm, int j) {
  const Eigen::Index number = calm.counts.col(j).count();
  if (number < kFewestCalm) return std::nullopt;
  const BalanceModel& m = fit.model();
  const double rms = std::sqrt(calm.torque.col(j).squaredNorm() / static_cast<double>(number));
  const RippledJoint of = rippled_joint(fit, calm, j, kNoRipple * rms);
  RippleRows rows;
  for (int k = 0; k < fit.count(); ++k)
    if (of.counts[k] > 0.0)
      rows.add(fit.rows().q(k, j), fit.rows().dq(k, j), fit.rows().torque(k, j), of.torque[k]);
  const bool slides = m.rigid.chain.geometry[j].kind == AxisKind::prismatic;
  return strongest_ripple(std::move(rows), m.setting.kernel_s, m.q_high[j] - m.q_low[j],
                          {.form = RippleForm::constant,
                           .least_explained = kMostly,
                           .least_waves = slides ? kLeastWavesOfSlide : kLeastWaves,
                           .refinements = kRefinements});
}

/// Returns the step of the rate of ripple `r` of the day by Gauss and Newton: of the phase at one end of the
/// joint's range, rad, at most 1. Rows after the calm ones with large residuals, which may be those of a
/// fault, have less weight.
double phase_step(const LogFit& fit, const CalmRows& calm, int r) {
  const BalanceModel& m = fit.model();
  const DayLayout day = day_layout(m);
  const RippleRate at = m.setting.ripples[index_of(m, r)];
  const int j = at.joint.index();
  const double range = m.q_high[j] - m.q_low[j], step = kPhaseStep / range;
  RowSetting setting = m.setting;
  setting.ripples = {at, {at.joint, at.rate - step}, {at.joint, at.rate + step}};
  const MatrixXd column = balance_rows(fit.log(), setting, m.rigid, m.theta).column[j];
  const ColumnLayout layout = layout_of(m.rigid, setting);
  const auto waves = [&](int k) { return column.middleCols<2>(layout.ripple_sine(k)); };
  MatrixXd x(fit.count(), 3);
  x << waves(0), (waves(2) - waves(1)) * calm.day.segment<2>(day.ripple(r)) / (2.0 * kPhaseStep);
  const RippledJoint of = rippled_joint(fit, calm, j, std::numeric_limits<double>::infinity());
  const double noise = std::sqrt(autocovariance(fit.noise().joint[j])[0]);
  const VectorXd std = noise * fit.std().col(j), left = of.torque.cwiseQuotient(std);
  VectorXd weight = of.counts;
  for (Eigen::Index k = calm.torque.rows(); k < weight.size(); ++k)
    weight[k] /= 1.0 + Eigen::numext::abs2(left[k] / kFarResidual);
  x = std.cwiseInverse().asDiagonal() * x;
  const MatrixXd weighted = weight.asDiagonal() * x;
  const Eigen::Vector3d best = (weighted.transpose() * x).ldlt().solve(weighted.transpose() * left);
  return std::isfinite(best[2]) ? std::clamp(best[2], -1.0, 1.0) : 0.0;
}

/// Returns the model with a further ripple as an effect of the day.
BalanceModel with_ripple(BalanceModel m, const RippleRate& ripple) {
  m.setting.ripples.push_back(ripple);
  ++m.ripples_of_day;
  const VectorXd learned = m.theta, usual = m.day_variance;
  const double std = kRippleStd * m.torque_rms[ripple.joint.index()];
  m.theta = VectorXd::Zero(m.layout().count());
  m.theta.head(learned.size()) = learned;
  m.day_variance = VectorXd::Constant(day_layout(m).count(), std * std);
  m.day_variance.head(usual.size()) = usual;
  return m;
}

/// Returns the model of `fit` with refined rates of its ripples of the day, and one ripple more at each loud
/// joint for which one is found; none if neither changes it.
std::optional<BalanceModel> improved(const LogFit& fit) {
  const std::vector<double> level = noise_levels(fit);
  const CalmRows calm = calm_rows(fit);
  BalanceModel out = fit.model();
  bool changes = false;
  for (int r = 0; r < fit.model().ripples_of_day; ++r) {
    const double step = phase_step(fit, calm, r);
    RippleRate& ripple = out.setting.ripples[index_of(fit.model(), r)];
    ripple.rate += step / (out.q_high[ripple.joint.index()] - out.q_low[ripple.joint.index()]);
    changes = changes || std::abs(step) > kSamePhase;
  }
  for (int j = 0; j < fit.joints(); ++j) {
    if (level[j] < kLoud) continue;
    if (const std::optional<double> rate = ripple_of(fit, calm, j)) {
      out = with_ripple(std::move(out), {Joint::at(j), *rate});
      changes = true;
    }
  }
  return changes ? std::optional(std::move(out)) : std::nullopt;
}

}  // namespace

std::vector<double> noise_levels(const LogFit& fit) {
  std::vector<double> out;
  for (int j = 0; j < fit.joints(); ++j)
    out.push_back(
        std::sqrt(autocovariance(fit.noise().joint[j])[0] / autocovariance(fit.model().noise.joint[j])[0]));
  return out;
}

std::optional<DayEffect> ripple_of_day(const LogFit& fit, int j) {
  const BalanceModel& m = fit.model();
  const DayLayout at = day_layout(m);
  double square = 0.0, variance = 0.0;
  for (int r = 0; r < at.ripples; ++r) {
    if (m.setting.ripples[index_of(m, r)].joint != Joint::at(j)) continue;
    const auto sine_and_cosine = [&](const VectorXd& of) { return of.segment<2>(at.ripple(r)); };
    const double amplitude = sine_and_cosine(fit.healthy().day).squaredNorm();
    square += amplitude;
    variance += amplitude * sine_and_cosine(fit.healthy().day_std).cwiseAbs2().maxCoeff();
  }
  if (square == 0.0) return std::nullopt;
  return DayEffect{DayEffectKind::torque_ripple, Joint::at(j), std::sqrt(square),
                   std::sqrt(variance / square)};
}

std::optional<BalanceModel> with_ripples_of_day(const UniformLog& log, const BalanceModel& model,
                                                const std::vector<FaultClaim>& known) {
  std::optional<BalanceModel> out;
  for (int round = 0; round < kMostRounds; ++round) {
    std::optional<BalanceModel> better = improved(LogFit(log, out ? *out : model, known));
    if (!better) break;
    out = std::move(better);
  }
  return out;
}

}  // namespace faultline
