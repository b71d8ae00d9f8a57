// SPDX-License-Identifier: MIT
#include "lib/identify/weak_system.hpp"

#include <cmath>

namespace faultline {
namespace {

constexpr double kBlock_s = 1.0;

}  // namespace

int nearest_width(const ParameterSpace& space, const Eigen::VectorXd& parameters, int joint) {
  int best = 0;
  const auto distance = [&](int k) {
    return std::abs(std::log(weak_width(space, joint, k)) - parameters[space.log_width(joint)]);
  };
  for (int k = 1; k < kWidths; ++k)
    if (distance(k) < distance(best)) best = k;
  return best;
}

WeakSystem assemble(const WeakWindows& windows, const Eigen::VectorXd& parameters) {
  const ParameterSpace& space = windows.space();
  const int n = space.joints(), count = static_cast<int>(windows.all().size());
  WeakSystem s;
  s.joints = n;
  s.a.setZero(count * n, space.linear());
  s.y.resize(count * n);
  s.use.setOnes(count * n);
  std::vector<int> width;
  for (int j = 0; j < n; ++j) width.push_back(nearest_width(space, parameters, j));
  double start = 0.0;
  int block = -1, log = -1;
  for (int k = 0; k < count; ++k) {
    const WeakWindow& w = windows.all()[k];
    if (w.log != log || w.time_s - start >= kBlock_s) {
      ++block;
      log = w.log;
      start = w.time_s;
    }
    s.a.block(k * n, 0, n, space.rigid()) = w.base;
    for (int j = 0; j < n; ++j) {
      s.a(k * n + j, space.viscous(j)) = w.viscous[j];
      s.a(k * n + j, space.coulomb(j)) = w.coulomb(j, width[j]);
      s.a(k * n + j, space.offset(j)) = 1.0;
      s.a(k * n + j, space.timing()) = -w.timing[j];
      s.y[k * n + j] = w.torque[j];
      s.block.push_back(block);
    }
  }
  return s;
}

}  // namespace faultline
