// SPDX-License-Identifier: MIT
#include "lib/explain/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/balance/smoothing.hpp"
#include "lib/core/elementary/elementary.hpp"
#include "lib/explain/drift_search.hpp"
#include "lib/explain/sensor_jumps.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array kBlows_s{.02, .05, .1, .25};  // lengths of a collision
constexpr double kRest_s = 0.15;       // at the end of a log that a joint which stands still is measured by
constexpr double kSurelyStands = 8.0;  // standard deviations
constexpr double kSpringDoubt = 0.3;   // of a spring's way
constexpr double kLeastTolerance = 1e-5;                 // rad or m
constexpr double kLeastNoise = 1e-6;                     // rad or m
constexpr double kJumpScore = 10.0, kRepeatScore = 1e3;  // nats: such onsets are judged first

void append(std::vector<Candidate> more, std::vector<Candidate>& out) {
  out.insert(out.end(), more.begin(), more.end());
}

/// An unknown force of some length on any joint.
std::vector<Candidate> search_collision(const WhiteSearch& s) {
  std::vector<Candidate> out;
  const LogFit& fit = s.fit;
  const int rows = fit.count();
  for (const double length : kBlows_s) {
    const int m = std::max(1, static_cast<int>(std::lround(length / fit.model().setting.row_s())));
    VectorXd gain = VectorXd::Zero(rows);
    for (int j = 0; j < fit.joints(); ++j) {
      const VectorXd y = s.weighted(j);
      const double prior = fit.rows().torque.col(j).squaredNorm() / rows;
      VectorXd u = VectorXd::Zero(rows), w = VectorXd::Zero(rows);
      for (int t = 0; t < rows; ++t)
        for (int i = t; i < std::min(rows, t + m); ++i) {
          u[t] += y[i];
          w[t] += s.precision[j] / (fit.std()(i, j) * fit.std()(i, j));
        }
      for (int t = 0; t < rows; ++t)
        gain[t] += 0.5 * u[t] * u[t] / (w[t] + 1.0 / prior) - 0.5 * elementary::log1p(w[t] * prior);
    }
    append(peaks(fit, {FaultKind::collision, fit.joints()}, gain, 2), out);
  }
  return out;
}

/// Since when joint `j` stands still, but for its spring.
std::vector<Candidate> search_standstill(const LogFit& fit, int j) {
  const BalanceModel& m = fit.model();
  const double row_s = m.setting.row_s(), compliance = m.setting.compliance[j];
  const VectorXd torque = fit.rows().torque.col(j);
  VectorXd x = fit.rows().q.col(j) - compliance * torque;
  const int tail = std::min(fit.count(), static_cast<int>(kRest_s / row_s) + 3);
  std::vector<double> end(x.data() + fit.count() - tail, x.data() + fit.count());
  std::nth_element(end.begin(), end.begin() + tail / 2, end.end());
  const double rest = end[tail / 2];
  const double noise = std::max(m.q_noise[j] * fit.loudness()[j], kLeastNoise) *
                       gaussian_kernel(m.setting.kernel_s, m.setting.period_s).norm();
  const double tolerance = kSurelyStands * noise + kLeastTolerance +
                           kSpringDoubt * compliance * (torque.maxCoeff() - torque.minCoeff());
  int since = fit.count();
  while (since > 0 && std::abs(x[since - 1] - rest) <= tolerance) --since;
  const int first = std::max(6, static_cast<int>(kLead_s / row_s));
  std::vector<Candidate> out;
  for (const int before : {0, 2, 5})
    out.push_back({FaultKind::locked, j + 1,
                   fit.time_s()[std::clamp(since - before, first, fit.count() - kTail)], 0.0, 0.0});
  return out;
}

}  // namespace

std::vector<LinearFault> linear_faults(const LogFit& fit) {
  const BalanceModel& m = fit.model();
  const ColumnLayout layout = m.layout();
  const int rows = fit.count(), n = fit.joints();
  std::vector<LinearFault> out;
  for (int j = 0; j < n; ++j) {
    LinearFault loss{
        FaultKind::torque_loss, j + 1, {StackedColumns::Zero(rows * n, 1), VectorXd::Constant(1, 0.25)}, {}};
    loss.columns.column.col(0).segment(j * rows, rows) = fit.rows().torque.col(j);
    if (fit.has_piece() && carries_weight(m.rigid, j))
      for (const double size : {.4, .7, 1.}) loss.starts.push_back(VectorXd::Constant(1, size));
    out.push_back(std::move(loss));
  }
  for (int j = 0; j < n; ++j) {
    const double fv = m.theta[layout.viscous(j)], fc = m.theta[layout.coulomb(j)];
    LinearFault friction{
        FaultKind::friction_increase, j + 1, {StackedColumns::Zero(rows * n, 2), VectorXd(2)}, {}};
    friction.columns.column.col(0).segment(j * rows, rows) = fit.rows().column[j].col(layout.viscous(j));
    friction.columns.column.col(1).segment(j * rows, rows) = fit.rows().column[j].col(layout.coulomb(j));
    friction.columns.variance << 9.0 * fv * fv + 1e-6, 9.0 * fc * fc + 1e-6;
    if (fit.has_piece() && carries_weight(m.rigid, j)) {
      friction.starts.push_back(Eigen::Vector2d(fv, 1.5 * fc));
      friction.starts.push_back(Eigen::Vector2d(2.0 * fv, 3.0 * fc));
    }
    out.push_back(std::move(friction));
  }
  const double mass = carried_mass(fit);
  LinearFault payload{FaultKind::payload_change,
                      n,
                      {stacked(fit.tip_torque()), VectorXd::Constant(1, 0.36 * mass * mass)},
                      {}};
  if (fit.has_piece())
    for (const double share : {.25, .6, 1.}) payload.starts.push_back(VectorXd::Constant(1, share * mass));
  out.push_back(std::move(payload));
  return out;
}

double carried_mass(const LogFit& fit) {
  const Eigen::MatrixXd torque = torque_of(fit.rows(), fit.model().theta);
  double num = 0.0, den = 0.0;
  for (int j = fit.joints() - 1; j < fit.joints(); ++j) {
    num += torque.col(j).dot(fit.tip_torque().col(j));
    den += fit.tip_torque().col(j).squaredNorm();
  }
  return den > 0.0 ? std::abs(num / den) : 1.0;
}

std::vector<Candidate> search(const LogFit& fit, const std::vector<LinearFault>& linear) {
  const WhiteSearch s = white_search(fit);
  std::vector<Candidate> out;
  for (const LinearFault& fault : linear)
    append(peaks(fit, {fault.kind, fault.joint}, onset_gains(s, fault.columns), 2), out);
  for (int j = 0; j < fit.joints(); ++j) append(search_drift(s, j), out);
  append(search_collision(s), out);
  for (int j = 0; j < fit.joints(); ++j) {
    append(search_standstill(fit, j), out);
    for (const SensorJump& jump : sensor_jumps(fit, j))
      out.push_back({FaultKind::sensor_bias, j + 1, jump.onset_s, kJumpScore, jump.size});
    if (const auto run = repeated_to_the_end(fit, j)) {
      out.push_back({FaultKind::stuck_encoder, j + 1, run->onset_s, kRepeatScore, 0.0});
      out.push_back({FaultKind::locked, j + 1, run->onset_s, kRepeatScore, 0.0});
    }
  }
  return out;
}

}  // namespace faultline
