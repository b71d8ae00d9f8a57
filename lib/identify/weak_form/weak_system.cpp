// SPDX-License-Identifier: MIT
#include "lib/identify/weak_form/weak_system.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

constexpr double kResting = 0.03;  // of the speed of a joint's fastest window: below, the joint rests
constexpr double kShown = 1e-6;    // of a squared column: least share from moving joints

/// Returns the number of seconds of the logs in which a window begins.
double seconds_covered(const WeakWindows& windows) {
  std::set<std::pair<int, long>> seconds;
  for (const WeakWindow& w : windows.all()) seconds.emplace(w.log, static_cast<long>(std::floor(w.time_s)));
  return static_cast<double>(seconds.size());
}

}  // namespace

double residual_block_s(double total_s, double parameters) {
  // Bounds of a block's length, and the number of blocks for each parameter.
  constexpr double kLongest_s = 1.0, kShortest_s = 0.1, kBlocksPerParameter = 5.0;
  return std::clamp(total_s / (kBlocksPerParameter * parameters), kShortest_s, kLongest_s);
}

std::vector<bool> moving_windows(const WeakSets& windows, int set, int joint) {
  const std::vector<WeakWindow>& all = windows.sets[set].all();
  if (has_joint(windows.still, joint)) return std::vector<bool>(all.size(), false);
  double fastest = 0.0;
  for (const WeakWindow& w : all) fastest = std::max(fastest, w.speed[joint]);
  std::vector<bool> moving;
  for (const WeakWindow& w : all) moving.push_back(w.speed[joint] >= kResting * fastest);
  return moving;
}

WeakSystem assemble(const WeakSets& windows, const WeakChoice& choice) {
  const ParameterSpace& space = windows.space;
  WeakSystem s;
  s.joints = space.joints();
  s.width.resize(s.joints);
  Eigen::Index rows = 0;
  for (int j = 0; j < s.joints; ++j) {
    rows += static_cast<Eigen::Index>(windows.sets[choice.set[j]].all().size());
    s.width[j] = elementary::log(weak_width(space, j, choice.width[j]));
  }
  s.a.setZero(rows, space.linear());
  s.y.resize(rows);
  s.use.setOnes(rows);
  const double block_s = residual_block_s(seconds_covered(windows.sets[0]), space.linear());
  std::map<std::pair<int, long>, int> blocks;
  Eigen::Index row = 0;
  for (int j = 0; j < s.joints; ++j) {
    const WeakWindows& set = windows.sets[choice.set[j]];
    const std::vector<bool> moving = moving_windows(windows, choice.set[j], j);
    const int at = choice.shift[j] - windows.shifts.first, before = std::max(at - 1, 0);
    for (std::size_t k = 0; k < set.all().size(); ++k, ++row) {
      const WeakWindow& w = set.all()[k];
      s.a.row(row).head(space.rigid()) = w.base.row(j);
      s.a(row, space.viscous(j)) = w.viscous[j];
      s.a(row, space.coulomb(j)) = w.coulomb(j, choice.width[j]);
      s.a(row, space.offset(j)) = 1.0;
      s.a(row, space.bend(j)) = w.coulomb(j, choice.bend[j]);
      s.a(row, space.skew(j)) = w.skew[j];
      s.a.row(row).segment(space.extra_begin(), w.extra.cols()) = w.extra.row(j);
      s.a(row, space.timing()) = w.torque(j, at) - w.torque(j, before);
      s.y[row] = w.torque(j, at);
      if (!moving[k]) s.use[row] = 0.0;
      const std::pair<int, long> second{w.log, static_cast<long>(std::floor(w.time_s / block_s))};
      s.joint.push_back(j);
      s.log.push_back(w.log);
      s.block.push_back(blocks.emplace(second, static_cast<int>(blocks.size())).first->second);
    }
  }
  s.blocks = static_cast<int>(blocks.size());
  return s;
}

bool is_shown_at_rest(const WeakSystem& system, int p, const std::vector<int>& still) {
  double all = 0.0, moving = 0.0;
  for (Eigen::Index k = 0; k < system.a.rows(); ++k) {
    const double square = system.a(k, p) * system.a(k, p);
    all += square;
    if (!has_joint(still, system.joint[k])) moving += square;
  }
  return moving <= kShown * all;
}

}  // namespace faultline
