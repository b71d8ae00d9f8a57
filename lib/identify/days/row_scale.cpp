// SPDX-License-Identifier: MIT
#include "lib/identify/days/row_scale.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "lib/balance/smoothing.hpp"

namespace faultline {
namespace {

using Eigen::VectorXd;

// Kernel of logs with little noise, standard deviation: the longer one for sample periods from kHighRate_s
// on.
constexpr double kHighRate_s = 0.005, kKernelAtHighRate_s = 0.012, kKernel_s = 0.016;
constexpr double kFriction_s = 0.006;  // kernel of the velocity that friction depends on, of such logs
constexpr double kWidest = 4.0;        // times that kernel: a wider one would hide short faults
constexpr double kWider = 1.1892;      // ratio of two kernels that are tried: four of them double it
// Noise of an acceleration as a share of it. Up to the first, the narrowest kernel finds and names most
// faults. Beyond it, the estimated inertia is too small, the whitening filter takes the inertia that is left
// for noise and amplifies that of the encoder, and the fit collapses; a wider kernel then has to reach the
// second.
constexpr double kMostNoise = 0.25, kReducedNoise = 0.05;
constexpr double kSamplesOfKernel = 6.0;  // in a kernel's standard deviation: it cannot resolve finer ones
constexpr double kSlackOfRate = 0.1;      // samples: a period is known to some per cent

/// Signal of one joint from which its acceleration follows, with the standard deviation of its white noise.
struct NoisySignal {
  std::vector<VectorXd> logs;
  double noise = 0.0;
  int derivatives = 2;  ///< from the signal to the acceleration: 2 of a position, 1 of a velocity
};

/// Returns the variance of the noise of the acceleration: that of white noise after differentiation and a
/// Gaussian kernel of standard deviation `kernel_s`.
double acceleration_noise(const NoisySignal& signal, double period_s, double kernel_s) {
  const double white = signal.noise * signal.noise * period_s / std::sqrt(std::numbers::pi);
  const double cube = kernel_s * kernel_s * kernel_s;
  return signal.derivatives == 1 ? white / (4.0 * cube) : 3.0 * white / (8.0 * cube * kernel_s * kernel_s);
}

/// Returns the mean square of the acceleration, noise included, where the kernel lies within the log.
double mean_square_acceleration(const NoisySignal& signal, double period_s, double kernel_s) {
  const VectorXd kernel = gaussian_kernel(kernel_s, period_s);
  double sum = 0.0, rows = 0.0;
  for (const VectorXd& log : signal.logs) {
    VectorXd x = smooth(log, kernel);
    for (int k = 0; k < signal.derivatives; ++k) x = gradient(x, period_s);
    const Eigen::Index inner = x.size() - 2 * (kernel.size() / 2 + signal.derivatives);
    if (inner <= 0) continue;
    sum += x.segment((x.size() - inner) / 2, inner).squaredNorm();
    rows += static_cast<double>(inner);
  }
  return sum / std::max(rows, 1.0);
}

/// Returns the noise of the acceleration as a share of the acceleration; infinity if the joint hardly moves.
double noise_share(const NoisySignal& signal, double period_s, double kernel_s) {
  const double noise = acceleration_noise(signal, period_s, kernel_s);
  const double motion = mean_square_acceleration(signal, period_s, kernel_s) - noise;
  return motion > 0.0 ? std::sqrt(noise / motion) : std::numeric_limits<double>::infinity();
}

/// Returns the kernel that suits the signal: `shortest_s` if it has little noise or the joint hardly moves.
double kernel_for(const NoisySignal& signal, double period_s, double shortest_s) {
  if (noise_share(signal, period_s, shortest_s) <= kMostNoise) return shortest_s;
  const double widest_s = kWidest * shortest_s;
  if (noise_share(signal, period_s, widest_s) >= 1.0) return shortest_s;  // the joint hardly moves
  double kernel_s = shortest_s;
  while (kernel_s < widest_s && noise_share(signal, period_s, kernel_s) > kReducedNoise) kernel_s *= kWider;
  return std::min(kernel_s, widest_s);
}

NoisySignal signal_of(const std::vector<UniformLog>& logs, int j, bool velocity) {
  NoisySignal out;
  std::vector<VectorXd> noise;
  for (const UniformLog& log : logs) {
    out.logs.emplace_back((velocity ? log.dq : log.q).col(j));
    noise.push_back((velocity ? log.dq_noise : log.q_noise).segment(j, 1));
  }
  out.noise = joint_medians(noise)[0];
  out.derivatives = velocity ? 1 : 2;
  return out;
}

}  // namespace

RowScale row_scale(const std::vector<UniformLog>& logs, const std::vector<bool>& derived) {
  const double period_s = logs.front().period_s;
  const double shortest_s = period_s < kHighRate_s ? kKernelAtHighRate_s : kKernel_s;
  const bool has_velocity =
      std::all_of(logs.begin(), logs.end(), [](const UniformLog& log) { return log.dq.rows() > 0; });
  double kernel_s = shortest_s;
  for (int j = 0; j < logs.front().joints(); ++j) {
    double own_s = kernel_for(signal_of(logs, j, false), period_s, shortest_s);
    if (has_velocity && !derived[j])
      own_s = std::min(own_s, kernel_for(signal_of(logs, j, true), period_s, shortest_s));
    kernel_s = std::max(kernel_s, own_s);
  }
  const double samples = kernel_s / kSamplesOfKernel / period_s;
  return {kernel_s, kFriction_s * kernel_s / shortest_s,
          std::max(1, static_cast<int>(samples + kSlackOfRate))};
}

}  // namespace faultline
