// SPDX-License-Identifier: MIT
#include "lib/plausibility/checkup/torque_relation.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/matrix/decompositions.hpp"
#include "lib/plausibility/checkup/valley.hpp"

namespace faultline {
namespace {

constexpr double kSmoothing_s = 0.015;
constexpr std::size_t kMostHalf = 200;  // rows
constexpr std::int64_t kFewestRows = 100;
constexpr double kFriction = 0.02;  // rad/s or m/s over which friction changes its sign
constexpr double kRelationGapSteps = 3.0;
constexpr double kRidge = 1e-10;
constexpr double kTells = 0.6;       // partial correlation from which on a delay is estimated
constexpr double kExplained = 0.9;   // share of the torque, likewise
constexpr double kStride_s = 0.006;  // between the delays that are tried, at least one row
constexpr double kDoubt_s = 0.025;   // uncertainty of delays, as other joints' motion has its part in torques

std::size_t half_rows(double period_s) {
  return std::clamp<std::size_t>(static_cast<std::size_t>(std::lround(kSmoothing_s / period_s)), 1,
                                 kMostHalf);
}

/// Returns accelerations, velocities, their directions and products, and a constant.
Eigen::VectorXd motion_of(const Eigen::VectorXd& acceleration, const Eigen::VectorXd& velocity) {
  const Eigen::Index n = velocity.size();
  Eigen::VectorXd motion(3 * n + n * (n + 1) / 2 + 1);
  motion.head(n) = acceleration;
  motion.segment(n, n) = velocity;
  motion.segment(2 * n, n) = velocity.array() / (velocity.array().abs() + kFriction);
  Eigen::Index at = 3 * n;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = i; k < n; ++k) motion[at++] = velocity[i] * velocity[k];
  motion[at] = 1.0;
  return motion;
}

/// Writes `latest` to column 0 and moves the others up.
void push_front(Eigen::MatrixXd& ring, const Eigen::VectorXd& latest) {
  for (Eigen::Index c = ring.cols() - 1; c > 0; --c) ring.col(c) = ring.col(c - 1);
  ring.col(0) = latest;
}

}  // namespace

TorqueRelation::TorqueRelation(int joints, double period_s)
    : joints_(joints),
      period_s_(period_s),
      half_(half_rows(period_s)),
      stride_(std::max(std::lround(kStride_s / period_s), 1L)),
      smoothed_(joints) {
  for (Smoothed& one : smoothed_) {
    one.q.resize(2 * half_ + 1);
    one.tau.resize(half_);
    one.means.resize(half_);
  }
  acceleration_.setZero(joints), velocity_.setZero(joints), torque_.setZero(joints);
  const Eigen::Index motions = motion_of(acceleration_, velocity_).size();
  motions_.setZero(motions, kMostStrides + 1);
  torques_.setZero(joints, kDelays);
  products_.setZero(motions, motions);
  with_.assign(kDelays, Eigen::MatrixXd::Zero(motions, joints));
  squares_.setZero(joints, kDelays);
  sums_.setZero(joints);
}

void TorqueRelation::restart() {
  run_ = taken_ = 0;
  for (Smoothed& one : smoothed_) {
    std::fill(one.tau.begin(), one.tau.end(), 0.0);
    std::fill(one.means.begin(), one.means.end(), 0.0);
    one.tau_sum = one.mean_sum = 0.0;
  }
}

void TorqueRelation::add(double t, const std::vector<std::vector<double>>& q,
                         const std::vector<std::vector<double>>& tau, std::size_t row) {
  bool whole = run_ == 0 || t - t_ <= kRelationGapSteps * period_s_;
  t_ = t;
  if (!whole) restart();
  for (int j = 0; j < joints_; ++j) whole = whole && !std::isnan(q[j][row]) && !std::isnan(tau[j][row]);
  if (!whole) return restart();
  const auto i = static_cast<std::size_t>(run_++);
  const double half = static_cast<double>(half_), span_s = half * period_s_;
  for (int j = 0; j < joints_; ++j) {
    Smoothed& one = smoothed_[j];
    torque_[j] = one.smooth;  // centred at the time of the acceleration
    one.tau_sum += tau[j][row] - one.tau[i % half_];
    one.tau[i % half_] = tau[j][row];
    const double mean = one.tau_sum / half;
    one.mean_sum += mean - one.means[i % half_];
    one.means[i % half_] = mean;
    one.smooth = one.mean_sum / half;
    const std::size_t ring = one.q.size();
    one.q[i % ring] = q[j][row];
    const double first = one.q[(i + 1) % ring], middle = one.q[(i + 1 + half_) % ring];
    velocity_[j] = (q[j][row] - first) / (2.0 * span_s);
    acceleration_[j] = (q[j][row] - 2.0 * middle + first) / (span_s * span_s);
  }
  if (i >= 2 * half_ && i % static_cast<std::size_t>(stride_) == 0) take();
}

void TorqueRelation::take() {
  push_front(torques_, torque_);
  push_front(motions_, motion_of(acceleration_, velocity_));
  if (++taken_ < kDelays) return;
  ++count_;
  const Eigen::VectorXd motion = motions_.col(kMostStrides);
  products_.selfadjointView<Eigen::Lower>().rankUpdate(motion);
  for (int d = 0; d < kDelays; ++d) with_[d] += motion * torques_.col(d).transpose();
  squares_ += torques_.cwiseAbs2();
  sums_ += torques_.col(kMostStrides);
}

TorqueRelated TorqueRelation::related(int joint, const Eigen::MatrixXd& inverse) const {
  TorqueRelated found;
  const double count = static_cast<double>(count_), mean = sums_[joint] / count;
  std::vector<double> left;
  int best = kDelays - 1;
  for (int d = kDelays - 1; d >= 0; --d) {  // column d, d strides old, is late by kMostStrides - d
    const Eigen::VectorXd with = with_[d].col(joint);
    left.push_back(squares_(joint, d) - with.dot(inverse * with));
    if (left.back() < left[kDelays - 1 - best]) best = d;
  }
  const Eigen::VectorXd factors = inverse * with_[best].col(joint);
  const double rest = left[kDelays - 1 - best];
  const double all = squares_(joint, best) - count * mean * mean;
  if (!(all > 0.0) || !(rest > 0.0)) return found;
  found.explained = std::clamp(1.0 - rest / all, 0.0, 1.0);
  found.inertia = factors[joint];
  const double t = factors[joint] * factors[joint] / (inverse(joint, joint) * rest);
  found.correlation = std::copysign(std::sqrt(t / (1.0 + t)), factors[joint]);
  if (std::abs(found.correlation) > kTells && found.explained > kExplained) {
    found.delay_rows = static_cast<double>(stride_) * (valley_of(left) - kMostStrides);
    found.delay_uncertainty_rows = 0.5 + kDoubt_s / period_s_;
  }
  return found;
}

std::vector<TorqueRelated> TorqueRelation::result() const {
  std::vector<TorqueRelated> all(joints_);
  if (count_ < kFewestRows) return all;
  Eigen::MatrixXd whole = products_.selfadjointView<Eigen::Lower>();
  const Eigen::VectorXd sizes = (whole.diagonal().array() + 1e-12).sqrt();
  whole = sizes.cwiseInverse().asDiagonal() * whole * sizes.cwiseInverse().asDiagonal();
  whole.diagonal().array() += kRidge;
  Eigen::MatrixXd inverse = inverse_definite(whole);
  inverse = sizes.cwiseInverse().asDiagonal() * inverse * sizes.cwiseInverse().asDiagonal();
  for (int j = 0; j < joints_; ++j) all[j] = related(j, inverse);
  return all;
}

}  // namespace faultline
