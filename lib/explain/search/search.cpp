// SPDX-License-Identifier: MIT
#include "lib/explain/search/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "lib/balance/smoothing.hpp"
#include "lib/core/elementary/elementary.hpp"
#include "lib/core/statistics.hpp"
#include "lib/explain/search/sensor_jumps.hpp"
#include "lib/explain/search/standstill.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array kBlows_s{.02, .05, .1, .25};  // lengths of a collision
constexpr std::array kLengths_s{.3, 1., 3.};       // lengths of faults that end
constexpr double kEndsScore = 10.0;                // nats by which an end must explain more in the search
constexpr double kJumpScore = 10.0,
                 kRepeatScore = 1e3;  // nats: repeats are judged first, jumps if little else stands out
constexpr double kShift = 1e-3;       // rad or m of a numeric derivative
constexpr std::array kDrifts{.003, .006, .012, .02, .03, .04, .06, .1};  // rad/s
constexpr double kSlideShare = 0.5;   // m/s of a slide for each rad/s of a revolute joint
constexpr double kKernelReach = 4.0;  // standard deviations at which the kernel is cut
constexpr double kNoTorque = 1e-9;    // N m for each rad, below which the position of a joint has no effect

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
    ArrayXd gain = ArrayXd::Zero(rows);
    for (int j = 0; j < fit.joints(); ++j) {
      const double prior = fit.rows().torque.col(j).squaredNorm() / rows;
      const ArrayXd left_over = u.row(j).array(), weight_over = w.row(j).array();
      gain += 0.5 * left_over.square() / (weight_over + 1.0 / prior) -
              0.5 * (weight_over * prior).unaryExpr(&elementary::log1p);
    }
    append(peaks(fit, {FaultKind::collision, fit.last_joint()}, gain, 2), out);
  }
  return out;
}

/// Returns onsets of a lock: since when joint `j` (from 0) stands still (still_since()).
std::vector<Candidate> search_standstill(const LogFit& fit, int j) {
  const int since = still_since(fit, j);
  std::vector<Candidate> out;
  for (const int before : {0, 2, 5}) {
    const int row = std::clamp(since - before, first_onset_row(fit, FaultKind::locked), fit.count() - kTail);
    out.push_back({{FaultKind::locked, Joint::at(j), fit.time_s()[row]}});
  }
  return out;
}

/// Returns the jumps of a position: those that last, and those that a later one reverses.
std::vector<Candidate> search_jumps(const LogFit& fit, int j) {
  const std::vector<SensorJump> jumps = sensor_jumps(fit, j);
  std::vector<Candidate> out;
  for (const SensorJump& jump : jumps) {
    FaultClaim claim{FaultKind::sensor_bias, Joint::at(j), jump.onset_s, kNeverEnds,
                     VectorXd::Constant(1, jump.size)};
    out.push_back({claim, kJumpScore});
    const std::optional<double> back_s = taken_back_s(jumps, claim);
    if (!back_s) continue;
    claim.end_s = *back_s;
    out.push_back({claim, kJumpScore});
  }
  return out;
}

/// Impulse of a jump of a joint's velocity by 1 rad/s, by onset: its product with the residual, and its own
/// square.
struct Impulse {
  VectorXd product, square;
};

/// Returns the impulses of a joint; `inertia`: its column of the inertia matrix, rows x joints.
Impulse impulse_of(const WhiteSearch& s, const MatrixXd& inertia) {
  const LogFit& fit = s.fit;
  const RowSetting& setting = fit.model().setting;
  const int rows = fit.count(),
            half = static_cast<int>(std::ceil(kKernelReach * setting.kernel_s / setting.row_s()));
  VectorXd kernel(2 * half + 1);
  for (int k = -half; k <= half; ++k)
    kernel[half + k] = normal_density(k * setting.row_s(), setting.kernel_s);
  VectorXd vector = VectorXd::Zero(rows), square = VectorXd::Zero(rows);
  for (int i = 0; i < fit.joints(); ++i) {
    if (inertia.col(i).isZero(0.0)) continue;
    const VectorXd y = s.weight.segment(i * rows, rows).cwiseProduct(s.left.segment(i * rows, rows));
    for (int t = 0; t < rows; ++t) {
      const int a = std::max(0, t - half), b = std::min(rows, t + half + 1);
      vector[t] -= inertia(t, i) * y.segment(a, b - a).dot(kernel.segment(a - t + half, b - a));
      square[t] += s.weight[i * rows + t] * inertia(t, i) * inertia(t, i) * kernel.squaredNorm();
    }
  }
  return {std::move(vector), std::move(square)};
}

/// Changes of the residual by a false position: by 1 rad or m (`slope`), and by 1 rad or m more in each
/// second since the first row (`growing`). A drift that begins at time t is `growing` - t `slope`.
struct DriftingPosition {
  Stacked growing, slope;
};

DriftingPosition drifting_position(const LogFit& fit, int j) {
  MeasuredMotion moved = reading_of(fit.log(), j);
  moved.q.array() += kShift;
  DriftingPosition out;
  out.slope = (fit.residual_of(moved, j, fit.log().start_s) - fit.residual()) / kShift;
  const VectorXd time = fit.time_s().array() - fit.time_s()[0];
  out.growing = out.slope.cwiseProduct(time.replicate(fit.joints(), 1));
  return out;
}

/// Sums over each row and all later ones of two columns: friction with another velocity, and the position
/// that drifts.
class DriftSums {
 public:
  DriftSums(const WhiteSearch& s, int j)
      : s_(s),
        joint_(j),
        position_(drifting_position(s.fit, j)),
        has_torque_(!position_.slope.isZero(kNoTorque)),
        time_(s.fit.time_s().array() - s.fit.time_s()[0]),
        growing_growing_(sums_from_each_row(s, position_.growing, position_.growing)),
        growing_slope_(sums_from_each_row(s, position_.growing, position_.slope)),
        slope_slope_(sums_from_each_row(s, position_.slope, position_.slope)),
        growing_left_(sums_from_each_row(s, position_.growing, s.left)),
        slope_left_(sums_from_each_row(s, position_.slope, s.left)),
        effects_(effect_sums_from_each_row(s, position_.growing) -
                 effect_sums_from_each_row(s, position_.slope) * time_.matrix().asDiagonal()) {}

  /// Returns the nats, by onset, for each of some drifts d (rad/s or m/s), with the torque that it adds by
  /// friction of the joint (`friction`, rows x drifts).
  MatrixXd gains(const MatrixXd& friction, const VectorXd& d) const {
    MatrixXd out = 0.5 * effect_squares(friction, d);
    Stacked column = Stacked::Zero(friction.rows() * s_.fit.joints());
    for (Eigen::Index i = 0; i < d.size(); ++i) {
      column.segment(joint_ * friction.rows(), friction.rows()) = friction.col(i);
      out.col(i) += gain_without_effects(column, d[i]).matrix();
    }
    return out;
  }

 private:
  ArrayXd gain_without_effects(const Stacked& friction, double d) const {
    ArrayXd with_left = sums_from_each_row(s_, friction, s_.left).array();
    ArrayXd square = sums_from_each_row(s_, friction, friction).array();
    if (has_torque_) {
      with_left += d * (growing_left_ - time_ * slope_left_);
      square += 2.0 * d *
                    (sums_from_each_row(s_, friction, position_.growing).array() -
                     time_ * sums_from_each_row(s_, friction, position_.slope).array()) +
                d * d * (growing_growing_ - time_ * (2.0 * growing_slope_ - time_ * slope_slope_));
    }
    return with_left - 0.5 * square;
  }

  /// Returns the squared sums with the effects, onsets x drifts: one pass over the rows for all drifts.
  MatrixXd effect_squares(const MatrixXd& friction, const VectorXd& d) const {
    const auto rows = friction.rows();
    const MatrixXd& effects = s_.effects[joint_];
    MatrixXd sums = MatrixXd::Zero(effects.rows(), d.size()), out(rows, d.size());
    for (Eigen::Index t = rows; t-- > 0;) {
      const double weight = s_.weight[joint_ * rows + t];
      for (Eigen::Index i = 0; i < d.size(); ++i) {
        sums.col(i) += effects.col(t) * (weight * friction(t, i));
        out(t, i) =
            has_torque_ ? (sums.col(i) + d[i] * effects_.col(t)).squaredNorm() : sums.col(i).squaredNorm();
      }
    }
    return out;
  }

  const WhiteSearch& s_;
  int joint_ = 0;
  DriftingPosition position_;
  bool has_torque_ = false;  ///< the position of the joint changes some torque
  ArrayXd time_;
  ArrayXd growing_growing_, growing_slope_, slope_slope_, growing_left_, slope_left_;
  MatrixXd effects_;  ///< with the position that drifts by 1 rad/s or m/s: effects x onsets
};

/// Returns the columns of the inertia matrix (kg m^2, kg m or kg) in each row, by joint: rows x joints.
std::vector<MatrixXd> inertia_rows(const LogFit& fit) {
  const BalanceModel& m = fit.model();
  const Chain chain = chain_of(m.rigid, m.theta);
  std::vector<MatrixXd> out(fit.joints(), MatrixXd(fit.count(), fit.joints()));
  for (int t = 0; t < fit.count(); ++t) {
    const JointVector q = fit.rows().q.row(t).transpose();
    const JointMatrix inertia = inertia_matrix(chain, q);
    for (int j = 0; j < fit.joints(); ++j) out[j].row(t) = inertia.col(j).transpose();
  }
  return out;
}

/// Returns onsets at which the position of joint `j` (from 0) may begin to drift, by friction at the true
/// velocity, growing errors of position and the jump of the velocity, for a few rates of drift.
std::vector<Candidate> search_drift(const WhiteSearch& s, const MatrixXd& inertia, int j) {
  std::vector<Candidate> out;
  const LogFit& fit = s.fit;
  const BalanceModel& m = fit.model();
  const ColumnLayout layout = m.layout();
  const double scale = m.rigid.chain.geometry[j].kind == AxisKind::revolute ? 1.0 : kSlideShare;
  const DriftSums sums(s, j);
  const Impulse impulse = impulse_of(s, inertia);
  const auto friction = [&](double v) {
    return m.theta[layout.viscous(j)] * v +
           m.theta[layout.coulomb(j)] * elementary::tanh(v / m.setting.friction_width[j]);
  };
  const VectorXd velocity = fit.rows().dq.col(j), as_read = velocity.unaryExpr(friction);
  VectorXd drifts(2 * kDrifts.size());
  MatrixXd changed(fit.count(), drifts.size());
  for (Eigen::Index i = 0; i < drifts.size(); ++i) {
    const double d = drifts[i] = scale * (i % 2 == 0 ? -1.0 : 1.0) * kDrifts[i / 2];
    changed.col(i) = velocity.unaryExpr([&](double v) { return friction(v - d); }) - as_read;
  }
  const MatrixXd gains = sums.gains(changed, drifts);
  for (Eigen::Index i = 0; i < drifts.size(); ++i) {
    const double d = drifts[i];
    const VectorXd gain = gains.col(i) + d * impulse.product - 0.5 * d * d * impulse.square;
    const FaultClaim drift{FaultKind::sensor_drift, Joint::at(j), 0.0, kNeverEnds, VectorXd::Constant(1, d)};
    append(peaks(fit, drift, gain, 1), out);
  }
  return out;
}

}  // namespace

std::vector<Candidate> search_drifts(const WhiteSearch& s) {
  const std::vector<MatrixXd> inertia = inertia_rows(s.fit);
  std::vector<Candidate> out;
  for (int j = 0; j < s.fit.joints(); ++j) append(search_drift(s, inertia[j], j), out);
  return out;
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
    for (const FaultSpan& run : repeated_codes(fit, j))
      for (const FaultKind kind : {FaultKind::stuck_encoder, FaultKind::locked})
        out.push_back({{kind, Joint::at(j), run.onset_s, run.end_s}, kRepeatScore});
  }
  std::erase_if(out, [&](const Candidate& c) { return fit.is_silent(c.joint, c.onset_s); });
  return out;
}

}  // namespace faultline
