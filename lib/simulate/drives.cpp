// SPDX-License-Identifier: MIT
#include "lib/simulate/drives.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/elementary/elementary.hpp"
#include "lib/simulate/joint_list.hpp"

namespace faultline {
namespace {

constexpr double kFinestStep = 0.25;  // of the correlation time; the random torque hardly changes in it

}  // namespace

Drives::Drives(int joints, const DriveSpec& spec, Random random)
    : gain_(or_all(spec.gain, joints, 0.0)),
      offset_(or_all(spec.offset, joints, 0.0)),
      roughness_(or_all(spec.roughness, joints, 0.0)),
      memory_s_(or_all(spec.roughness_memory_s, joints, 0.03)),
      limit_(or_all(spec.limit, joints, std::numeric_limits<double>::infinity())),
      rough_(joints, 0.0),
      random_(random) {
  for (int j = 0; j < joints; ++j)
    if (roughness_[j] > 0.0) rough_[j] = roughness_[j] * random_.normal();
}

void Drives::act(double length_s, JointVector& commanded) {
  for (int j = 0; j < commanded.size(); ++j) {
    const double given = (1.0 + gain_[j]) * commanded[j] + offset_[j] + mean_roughness(j, length_s);
    commanded[j] = std::clamp(given, -limit_[j], limit_[j]);
  }
}

double Drives::mean_roughness(int j, double length_s) {
  if (!(roughness_[j] > 0.0)) return 0.0;
  const int steps = static_cast<int>(std::ceil(length_s / (kFinestStep * memory_s_[j])));
  const double keeps = elementary::exp(-length_s / (steps * memory_s_[j]));
  const double stirs = roughness_[j] * std::sqrt(1.0 - keeps * keeps);
  double sum = 0.0;
  for (int k = 0; k < steps; ++k) {
    sum += rough_[j];
    rough_[j] = keeps * rough_[j] + stirs * random_.normal();
  }
  return sum / steps;
}

}  // namespace faultline
