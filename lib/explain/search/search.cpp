// SPDX-License-Identifier: MIT
#include "lib/explain/search/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/balance/smoothing.hpp"
#include "lib/core/elementary/elementary.hpp"
#include "lib/core/statistics.hpp"
#include "lib/explain/search/sensor_jumps.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array kBlows_s{.02, .05, .1, .25};  // lengths of a collision
constexpr std::array kLengths_s{.3, 1., 3.};       // lengths of faults that end
constexpr double kEndsScore = 10.0;                // nats by which an end must explain more in the search
constexpr double kRest_s = 0.15;        // at the end of a log that gives the position of a joint at rest
constexpr double kSurelyStands = 8.0;   // standard deviations of a position within which a joint stands still
constexpr double kSpringDoubt = 0.3;    // share of a gear spring's deflection: error of its model
constexpr double kJumpTakenBack = 0.3;  // share of a jump's size by which the jump back may differ
constexpr double kLeastTolerance = 1e-5;  // rad or m that a joint may move while it stands
constexpr double kLeastNoise = 1e-6;      // rad or m: noise of a position, at least
constexpr double kJumpScore = 10.0,
                 kRepeatScore = 1e3;  // nats: repeats are judged first, jumps if little else stands out

void append(std::vector<Candidate> more, std::vector<Candidate>& out) {
  out.insert(out.end(), more.begin(), more.end());
}

/// Returns onsets of a fault that lasts, and of one that ends after a while if that explains much more.
std::vector<Candidate> search_linear(const WhiteSearch& s, const LinearFault& fault) {
  std::vector<int> lengths = {0};
  for (const double length_s : kLengths_s)
    lengths.push_back(std::max(2, static_cast<int>(length_s / s.fit.model().setting.row_s())));
  const std::vector<VectorXd> gains = onset_gains(s, fault.columns, lengths);
  std::vector<Candidate> out = peaks(s.fit, {fault.kind, fault.joint}, gains[0], 2);
  const double stays = out.empty() ? 0.0 : out.front().score;
  for (std::size_t l = 0; l < std::size(kLengths_s); ++l)
    for (Candidate c : peaks(s.fit, {fault.kind, fault.joint}, gains[l + 1], 1)) {
      c.end_s = c.onset_s + kLengths_s[l];
      if (c.score > stays + kEndsScore && c.end_s < s.fit.time_s()[s.fit.count() - 1]) out.push_back(c);
    }
  return out;
}

/// Returns onsets of an unknown force on any joint, for some lengths.
std::vector<Candidate> search_collision(const WhiteSearch& s) {
  std::vector<Candidate> out;
  const LogFit& fit = s.fit;
  const int rows = fit.count();
  MatrixXd left(fit.joints(), rows), weight(fit.joints(), rows);  // sums from each row on
  for (int j = 0; j < fit.joints(); ++j) {
    Stacked push = Stacked::Zero(rows * fit.joints());
    push.segment(j * rows, rows).setOnes();
    left.row(j) = sums_from_each_row(s, push, s.left).transpose();
    weight.row(j) = sums_from_each_row(s, push, push).transpose();
  }
  for (const double length : kBlows_s) {
    const int m = std::max(1, static_cast<int>(std::lround(length / fit.model().setting.row_s())));
    const MatrixXd u = over_rows(left, m), w = over_rows(weight, m);
    Eigen::ArrayXd gain = Eigen::ArrayXd::Zero(rows);
    for (int j = 0; j < fit.joints(); ++j) {
      const double prior = fit.rows().torque.col(j).squaredNorm() / rows;
      const Eigen::ArrayXd left_over = u.row(j).array(), weight_over = w.row(j).array();
      gain += 0.5 * left_over.square() / (weight_over + 1.0 / prior) -
              0.5 * (weight_over * prior).unaryExpr(&elementary::log1p);
    }
    append(peaks(fit, {FaultKind::collision, fit.joints()}, gain, 2), out);
  }
  return out;
}

/// Returns onsets of a lock: since when joint `j` (from 0) stands still except for its spring.
std::vector<Candidate> search_standstill(const LogFit& fit, int j) {
  const double row_s = fit.model().setting.row_s();
  const Standstill stands = standstill(fit, j);
  const int tail = std::min(fit.count(), static_cast<int>(kRest_s / row_s) + 3);
  const double rest =
      upper_median({stands.place.data() + fit.count() - tail, stands.place.data() + fit.count()});
  int since = fit.count();
  while (since > 0 && std::abs(stands.place[since - 1] - rest) <= stands.tolerance) --since;
  const int first = std::max(6, static_cast<int>(kLead_s / row_s));
  std::vector<Candidate> out;
  for (const int before : {0, 2, 5})
    out.push_back(
        {{FaultKind::locked, j + 1, fit.time_s()[std::clamp(since - before, first, fit.count() - kTail)]}});
  return out;
}

/// Returns the jumps of a position: those that last, and those that a later one reverses.
std::vector<Candidate> search_jumps(const LogFit& fit, int j) {
  const std::vector<SensorJump> jumps = sensor_jumps(fit, j);
  std::vector<Candidate> out;
  for (const SensorJump& jump : jumps) {
    FaultClaim claim{FaultKind::sensor_bias, j + 1, jump.onset_s, kNeverEnds,
                     VectorXd::Constant(1, jump.size)};
    out.push_back({claim, kJumpScore});
    const SensorJump* back = nullptr;  // the next one that reverses it
    for (const SensorJump& other : jumps)
      if (other.onset_s > jump.onset_s &&
          std::abs(other.size + jump.size) < kJumpTakenBack * std::abs(jump.size) &&
          (back == nullptr || other.onset_s < back->onset_s))
        back = &other;
    if (back == nullptr) continue;
    claim.end_s = back->onset_s;
    out.push_back({claim, kJumpScore});
  }
  return out;
}

}  // namespace

Standstill standstill(const LogFit& fit, int j) {
  const BalanceModel& m = fit.model();
  const double compliance = m.compliance(j);
  const VectorXd torque = fit.rows().torque.col(j);
  const double noise = std::max(m.q_noise[j] * fit.loudness()[j], kLeastNoise) *
                       gaussian_kernel(m.setting.kernel_s, m.setting.period_s).norm();
  return {fit.rows().q.col(j) - compliance * torque,
          kSurelyStands * noise + kLeastTolerance +
              kSpringDoubt * compliance * (torque.maxCoeff() - torque.minCoeff())};
}

std::vector<Candidate> search(const LogFit& fit) {
  const WhiteSearch s = white_search(fit);
  std::vector<Candidate> out;
  for (const LinearFault& fault : fit.linear())
    if (!fault.columns.grow) append(search_linear(s, fault), out);
  append(search_drifts(s), out);
  append(search_collision(s), out);
  for (int j = 0; j < fit.joints(); ++j) {
    append(search_standstill(fit, j), out);
    append(search_jumps(fit, j), out);
    for (const RepeatedCode& run : repeated_codes(fit, j))
      for (const FaultKind kind : {FaultKind::stuck_encoder, FaultKind::locked})
        out.push_back({{kind, j + 1, run.onset_s, run.end_s}, kRepeatScore});
  }
  std::erase_if(out, [&](const Candidate& c) { return fit.is_silent(c.joint, c.onset_s); });
  return out;
}

}  // namespace faultline
