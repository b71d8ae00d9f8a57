// SPDX-License-Identifier: MIT
#include "lib/robot/turns.hpp"

#include <cmath>
#include <utility>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

constexpr double kDust = 1e-15;

double clean(double value) { return std::abs(value) < kDust ? 0.0 : value; }

std::pair<double, double> clean_sin_cos(double angle) {
  const auto [sine, cosine] = elementary::sin_cos(angle);
  return {clean(sine), clean(cosine)};
}

}  // namespace

Eigen::Matrix3d turn_x(double angle) {
  const auto [s, c] = clean_sin_cos(angle);
  Eigen::Matrix3d r;
  r << 1, 0, 0, 0, c, -s, 0, s, c;
  return r;
}

Eigen::Matrix3d turn_z(double angle) {
  const auto [s, c] = clean_sin_cos(angle);
  Eigen::Matrix3d r;
  r << c, -s, 0, s, c, 0, 0, 0, 1;
  return r;
}

Eigen::Matrix3d turn_rpy(const Eigen::Vector3d& rpy) {
  const auto [s, c] = clean_sin_cos(rpy.y());
  Eigen::Matrix3d pitch;
  pitch << c, 0, s, 0, 1, 0, -s, 0, c;
  return turn_z(rpy.z()) * pitch * turn_x(rpy.x());
}

Eigen::Vector3d without_dust(const Eigen::Vector3d& v) {
  const double largest = v.cwiseAbs().maxCoeff();
  return v.unaryExpr([&](double x) { return std::abs(x) < kDust * largest ? 0.0 : x; });
}

}  // namespace faultline
