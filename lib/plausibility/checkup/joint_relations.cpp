// SPDX-License-Identifier: MIT
#include "lib/plausibility/checkup/joint_relations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "lib/core/matrix/decompositions.hpp"

namespace faultline {
namespace {

/// Returns the index of the least value, interpolated by a parabola through it and the values up to three
/// places to both sides. NaN if the least one is the first or the last, or there is no distinct minimum.
double valley_of(std::span<const double> values) {
  std::size_t least = 0;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i] < values[least]) least = i;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  if (least == 0 || least + 1 >= values.size()) return nan;
  const std::size_t reach = std::min({least, values.size() - 1 - least, std::size_t{3}});
  const double left = values[least - reach], middle = values[least], right = values[least + reach];
  const double bend = left - 2.0 * middle + right;
  if (!(bend > 0.0)) return nan;
  return static_cast<double>(least) + 0.5 * static_cast<double>(reach) * (left - right) / bend;
}

constexpr double kLeastRms = 1e-3;        // rad/s or m/s; below it the joint rests
constexpr double kRoughest = 0.2;         // limit of the noise share in squared slopes of a moving joint
constexpr double kSameNoise = 0.04;       // of the slopes' mean square noise: limit for a difference
constexpr double kAboveRoughness = 20.0;  // least ratio of motion to noise, in squares, to estimate a delay
constexpr double kSimilar = 1.25;         // largest rms ratio to estimate a delay
/// White noise of variance s has second differences of variance 6 s.
constexpr double kBend = 6.0;

constexpr double kSmoothing_s = 0.015;
constexpr std::size_t kMostHalf = 200;  // rows
constexpr std::int64_t kFewestRows = 100;
constexpr double kFriction = 0.02;         // rad/s or m/s over which friction changes its sign
constexpr double kRelationGapSteps = 3.0;  // periods; a longer step interrupts the comparison
constexpr double kRidge = 1e-10;
constexpr double kExplained = 0.9;   // share of the torque that motion explains, least for a delay
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

void VelocityRelation::add(double t, double q, double dq) {
  if (std::isnan(q) || std::isnan(dq)) {
    run_ = 0;
    return;
  }
  if (run_ > 0 && t - t_ > kRelationGapSteps * period_s_) run_ = 0;
  if (run_ > 0) {
    std::copy_backward(slopes_.begin(), slopes_.end() - 1, slopes_.end());
    std::copy_backward(velocities_.begin(), velocities_.end() - 1, velocities_.end());
    std::copy_backward(steps_.begin(), steps_.end() - 1, steps_.end());
    slopes_[0] = (q - q_) / (t - t_);
    steps_[0] = q - q_;
    velocities_[0] = dq;
    if (run_ >= kDelays) compare();
  }
  t_ = t;
  q_ = q;
  ++run_;
}

void VelocityRelation::compare() {
  ++count_;
  const double dq = velocities_[kMostRows], slope = slopes_[kMostRows], after = slopes_[kMostRows - 1];
  velocity_squares_ += dq * dq;
  slope_squares_ += slope * slope;
  product_ += dq * slope;
  const double bend = after - 2.0 * slope + slopes_[kMostRows + 1];
  roughness_ += bend * bend / kBend;
  for (int i = 0; i < kDelays; ++i) off_[i] += (dq - slopes_[i]) * (dq - slopes_[i]);
  const double centred = dq - 0.5 * (slope + after);
  off_centred_ += centred * centred;
  const double step = steps_[kMostRows], next = steps_[kMostRows - 1], last = steps_[kMostRows + 1];
  step_roughness_ += (next - 2.0 * step + last) * (next - 2.0 * step + last) / kBend;
  for (const auto& [at, value] : {std::pair{0, step}, {1, 0.5 * (step + next)}}) {
    step_squares_[at] += value * value;
    step_products_[at] += value * dq;
  }
}

/// Whether the velocity is a multiple of the steps of position, with their noise.
bool VelocityRelation::is_of_steps() const {
  for (std::size_t i = 0; i < step_squares_.size(); ++i) {
    if (!(step_squares_[i] > 0.0)) continue;
    const double factor = step_products_[i] / step_squares_[i];
    const double off = velocity_squares_ - factor * step_products_[i];
    if (step_roughness_ > 0.0 && off < kSameNoise * factor * factor * step_roughness_) return true;
  }
  return false;
}

VelocityRelated VelocityRelation::result() const {
  VelocityRelated related;
  if (count_ < kFewestRows) return related;
  related.rms = std::sqrt(velocity_squares_ / static_cast<double>(count_));
  const double slope_rms = std::sqrt(slope_squares_ / static_cast<double>(count_));
  const bool moves = slope_rms > kLeastRms && roughness_ < kRoughest * slope_squares_;
  if (related.rms < kLeastRms && !moves) return related;
  if (slope_squares_ > 0.0) {
    related.rms_ratio = std::sqrt(velocity_squares_ / slope_squares_);
    related.noise_share = roughness_ / slope_squares_;
  }
  if (related.rms < kLeastRms) return related;
  const double least = std::min(off_centred_, *std::min_element(off_.begin(), off_.end()));
  related.is_difference = (roughness_ > 0.0 && least < kSameNoise * roughness_) || is_of_steps();
  const bool alike = related.rms_ratio < kSimilar && related.rms_ratio > 1.0 / kSimilar;
  if (alike && product_ > kAboveRoughness * roughness_)
    related.delay_rows = valley_of(off_) - kMostRows + 0.5;  // a slope belongs to a time half a row earlier
  return related;
}

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

TorqueRelated TorqueRelation::related(int j, const Eigen::MatrixXd& inverse) const {
  TorqueRelated found;
  const double count = static_cast<double>(count_), mean = sums_[j] / count;
  std::vector<double> left;
  int best = kDelays - 1;
  for (int d = kDelays - 1; d >= 0; --d) {  // column d, d strides old, is late by kMostStrides - d
    const Eigen::VectorXd with = with_[d].col(j);
    left.push_back(squares_(j, d) - with.dot(inverse * with));
    if (left.back() < left[kDelays - 1 - best]) best = d;
  }
  const Eigen::VectorXd factors = inverse * with_[best].col(j);
  const double rest = left[kDelays - 1 - best];
  const double all = squares_(j, best) - count * mean * mean;
  if (!(all > 0.0) || !(rest > 0.0)) return found;
  found.explained = std::clamp(1.0 - rest / all, 0.0, 1.0);
  found.inertia = factors[j];
  const double t = factors[j] * factors[j] / (inverse(j, j) * rest);
  found.correlation = std::copysign(std::sqrt(t / (1.0 + t)), factors[j]);
  if (std::abs(found.correlation) > TorqueRelated::kClear && found.explained > kExplained) {
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
