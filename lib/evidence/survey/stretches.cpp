// SPDX-License-Identifier: MIT
#include "lib/evidence/survey/stretches.hpp"

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

constexpr double kStretchesMoves = 0.1;  // of the usual speed: slower rows say nothing of torques

}  // namespace

std::vector<int> first_moving(const Log& rows, const MotionModel& model) {
  std::vector<int> moving;
  for (int s = 0; s < kStretches && moving.size() < 2; ++s) {
    const int begin = s * rows.rows() / kStretches, end = (s + 1) * rows.rows() / kStretches;
    bool moves = false;
    for (int j = 0; j < model.joints() && end - begin > 1; ++j) {
      const auto [low, high] = std::minmax_element(rows.q[j].begin() + begin, rows.q[j].begin() + end);
      moves = moves || *high - *low > kStretchesMoves * model.velocity_scale[j] *
                                          (rows.time[end - 1] - rows.time[begin]);
    }
    if (moves) moving.push_back(s);
  }
  return moving;
}

std::array<double, kStretches> way_of(const Log& rows, const MotionModel& model) {
  std::array<double, kStretches> way{};
  for (int j = 0; j < model.joints(); ++j) {
    double last = std::nan("");
    for (int k = 0; k < rows.rows(); ++k) {
      if (!std::isfinite(rows.q[j][k])) continue;
      const std::size_t stretch = stretch_of(k, rows.rows());
      if (std::isfinite(last) && model.velocity_scale[j] > 0.0)
        way[stretch] += std::abs(rows.q[j][k] - last) / model.velocity_scale[j];
      last = rows.q[j][k];
    }
  }
  return way;
}

}  // namespace faultline
