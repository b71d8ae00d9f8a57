// SPDX-License-Identifier: MIT
#include "lib/neural/kernels.hpp"

#include <bit>
#include <cmath>
#include <cstdint>

namespace faultline {
namespace {

/// tanh(x) = -(e^y - 1) / (e^y + 1), y = -2|x| = k ln 2 + r, e^r by the Pade approximant [5/5]
/// (E + O) / (E - O) with E even and O odd in r. Written so that nothing cancels near zero.
inline double tanh_of(double x) {
  constexpr double kRounder = 0x1.8p52;  // added and taken away: rounds to the nearest whole number
  constexpr double kLn2High = 0x1.62e42fefa3800p-1, kLn2Low = 0x1.ef35793c76730p-45;
  double a = std::fabs(x);
  a = a > 20.0 ? 20.0 : a;  // this way round NaN stays
  const double y = -2.0 * a;
  const double shifted = y * 1.4426950408889634 + kRounder;
  const double k = shifted - kRounder;
  const double r = (y - k * kLn2High) - k * kLn2Low;
  const double scale = std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) << 52) +
                                             std::bit_cast<std::uint64_t>(1.0));
  const double r2 = r * r;
  const double even = 1.0 + r2 * (1.0 / 9.0 + r2 * (1.0 / 1008.0));
  const double odd = r * (0.5 + r2 * (1.0 / 72.0 + r2 * (1.0 / 30240.0)));
  const double minus = even - odd;
  const double numerator = scale * (odd + odd) + (scale - 1.0) * minus;
  return std::copysign(numerator / (numerator + 2.0 * minus), x);
}

}  // namespace

void tanh_in_place(double* values, int count) {
  for (int first = 0; first < count; first += kLanes)
    for (int lane = 0; lane < kLanes; ++lane) values[first + lane] = tanh_of(values[first + lane]);
}

void affine_lanes(const Eigen::MatrixXd& weights, const Eigen::VectorXd& bias, const double* in,
                  double* out) {
  const int inputs = static_cast<int>(weights.cols()), outputs = static_cast<int>(weights.rows());
  for (int o = 0; o < outputs; ++o) {
    double sum[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) sum[lane] = bias[o];
    for (int i = 0; i < inputs; ++i) {
      const double weight = weights(o, i);
      for (int lane = 0; lane < kLanes; ++lane) sum[lane] += weight * in[i * kLanes + lane];
    }
    for (int lane = 0; lane < kLanes; ++lane) out[o * kLanes + lane] = sum[lane];
  }
}

void squared_distances_lanes(const Eigen::MatrixXd& centres, const Eigen::MatrixXd& inverse_radii,
                             const double* in, double* sums) {
  const int inputs = static_cast<int>(centres.rows()), units = static_cast<int>(centres.cols());
  for (int u = 0; u < units; ++u) {
    double sum[kLanes] = {};
    for (int i = 0; i < inputs; ++i) {
      const double centre = centres(i, u), inverse = inverse_radii(i, u);
      for (int lane = 0; lane < kLanes; ++lane) {
        const double z = (in[i * kLanes + lane] - centre) * inverse;
        sum[lane] += z * z;
      }
    }
    for (int lane = 0; lane < kLanes; ++lane) sums[u * kLanes + lane] = sum[lane];
  }
}

}  // namespace faultline
