// SPDX-License-Identifier: MIT
#include "lib/log/recorder/position_jumps.hpp"

#include <algorithm>

namespace faultline {
namespace {

constexpr int kEnoughOfJumps = 10;         // rows from which the usual distance is known
constexpr double kUsualForgetting = 0.02;  // weight of a new row in the usual distance
constexpr double kTimesUsual = 20.0;       // times the usual distance: more is neither noise nor rounding
constexpr double kLeastJump = 1e-3;        // rad or m, of a jump
constexpr double kBetweenRows = 0.5;       // of the larger velocity: a joint may be faster between two rows
constexpr double kSameStep = 5.5;          // usual steps: after a longer gap the motion is unknown

}  // namespace

double PositionJumps::excess(int from, int to) const {
  const double before = last_.dq(from), after = now_.dq(to), moved = now_.q(to) - last_.q(from);
  const double margin = std::abs(after - before) + kBetweenRows * std::max(std::abs(before), std::abs(after));
  const double fast = std::max(before, after) + margin, slow = std::min(before, after) - margin;
  const double most = std::max(fast * shortest_s_, fast * longest_s_);
  const double least = std::min(slow * shortest_s_, slow * longest_s_);
  return std::max({moved - most, least - moved, 0.0});
}

bool PositionJumps::jumps(int from, int to) const {
  const double usual = std::max(usual_[from], usual_[to]);
  return excess(from, to) > std::max(kTimesUsual * usual, kLeastJump);  // false if a value is missing
}

void PositionJumps::learn(int j) {
  const double way = 0.5 * (last_.dq(j) + now_.dq(j)) * (now_.t - last_.t);
  const double off = std::abs(now_.q(j) - last_.q(j) - way);
  if (!std::isfinite(off)) return;
  learned_[j] = std::min(learned_[j] + 1, kEnoughOfJumps);
  const double share = std::max(kUsualForgetting, 1.0 / learned_[j]);
  usual_[j] += learned_[j] < kEnoughOfJumps ? (off - usual_[j]) / learned_[j] : share * (off - usual_[j]);
}

const std::vector<int>& PositionJumps::take(const MeasuredRow& row, double usual_step_s) {
  jumped_.clear();
  if (!row.has_velocity) return jumped_;
  std::swap(last_, now_);
  now_ = row;
  usual_.resize(row.joints);
  learned_.resize(row.joints);
  const double step = row.t - last_.t;
  const bool follows = last_.joints == row.joints && step < kSameStep * usual_step_s;
  shortest_s_ = std::min(step, usual_step_s);
  longest_s_ = std::max(step, usual_step_s);
  for (int j = 0; j < row.joints && follows; ++j) {
    if (learned_[j] == kEnoughOfJumps && jumps(j, j))
      jumped_.push_back(j);
    else
      learn(j);
  }
  return jumped_;
}

std::optional<std::pair<int, int>> PositionJumps::swapped() const {
  if (jumped_.size() != 2) return {};
  const int a = jumped_[0], b = jumped_[1];
  if (jumps(a, b) || jumps(b, a)) return {};
  return std::pair{a, b};
}

}  // namespace faultline
