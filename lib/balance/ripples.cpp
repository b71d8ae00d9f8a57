// SPDX-License-Identifier: MIT
#include "lib/balance/ripples.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/golden_section.hpp"

namespace faultline {
namespace {

constexpr double kMostWaves = 700.0;  // radians over the range of a joint: faster ripples are noise
constexpr double kCut = 4.0;          // standard deviations at which a residual is cut

/// Subtracts the mean and cuts each value to kCut standard deviations.
void centre_and_cut(std::vector<double>& values) {
  Eigen::Map<Eigen::ArrayXd> v(values.data(), static_cast<Eigen::Index>(values.size()));
  v -= v.mean();
  const double most = kCut * std::sqrt(v.square().mean());
  v = v.max(-most).min(most);
}

/// Returns the squared residual that a ripple of this rate explains; the kernel weakens fast ones.
double explained(const RippleRows& c, double rate, double kernel_s, RippleForm form) {
  const double by_torque = form == RippleForm::constant_and_by_torque ? 1.0 : 0.0;
  Eigen::Matrix4d a = 1e-6 * Eigen::Matrix4d::Identity();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  for (std::size_t k = 0; k < c.q.size(); ++k) {
    const double slow = rate * c.dq[k] * kernel_s, gain = elementary::exp(-0.5 * slow * slow);
    const auto [s, co] = elementary::sin_cos(rate * c.q[k]);
    const double torque = by_torque * c.torque[k];
    const Eigen::Vector4d x(gain * s * torque, gain * co * torque, gain * s, gain * co);
    a += x * x.transpose();
    b += c.left[k] * x;
  }
  return b.dot(a.ldlt().solve(b));
}

}  // namespace

std::optional<double> strongest_ripple(RippleRows rows, double kernel_s, double range,
                                       const RippleBounds& bounds) {
  if (range <= 0.0 || rows.left.empty()) return std::nullopt;
  centre_and_cut(rows.left);
  double all = 0.0;
  for (const double v : rows.left) all += v * v;
  const auto explains = [&](double rate) { return explained(rows, rate, kernel_s, bounds.form); };
  double most = 0.0, best = 0.0;
  for (double waves = bounds.least_waves; waves < kMostWaves; waves += 1.0) {
    const double e = explains(waves / range);
    if (e > most) most = e, best = waves / range;
  }
  if (!(most > bounds.least_explained * all)) return std::nullopt;
  if (bounds.refinements == 0) return best;
  return golden_section(best - 1.0 / range, best + 1.0 / range, bounds.refinements,
                        [&](double rate) { return -explains(rate); });
}

}  // namespace faultline
