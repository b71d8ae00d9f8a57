// SPDX-License-Identifier: MIT
#include "lib/log/recorder/measured_rows.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace faultline {
namespace {

/// FNV-1a over 64-bit words; a shift after each makes the low bits depend on all bits.
std::uint64_t hash_of(const MeasuredRow& row) {
  constexpr std::uint64_t kOffset = 14695981039346656037ULL, kPrime = 1099511628211ULL;
  constexpr int kHalf = 32;
  std::uint64_t hash = kOffset;
  for (const double value : row.values) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * kPrime;
    hash ^= hash >> kHalf;
  }
  return hash;
}

constexpr int kEnoughOfJumps = 10;         // rows from which the usual distance is known
constexpr double kUsualForgetting = 0.02;  // weight of a new row in the usual distance
constexpr double kTimesUsual = 20.0;       // times the usual distance: more is neither noise nor rounding
constexpr double kLeastJump = 1e-3;        // rad or m, of a jump
constexpr double kBetweenRows = 0.5;       // of the larger velocity: a joint may be faster between two rows
constexpr double kSameStep = 5.5;          // usual steps: after a longer gap the motion is unknown

constexpr double kShortestStop_s = 0.25;  // a source that measures less often than it is read holds for less
constexpr int kFewestRepeats = 4;         // at slow rates, at which a quarter of a second is hardly a row
constexpr int kMostUndecided = 4096;      // most rows that wait for a decision
constexpr double kLongerThanUsual = 4.0;  // times the longest hold of this log after which joints moved
constexpr double kMoved = 3e-4;           // rad or m: velocity noise over a short rest stays below it
constexpr double kFaster = 2.0;           // times the velocity: a joint may brake between two rows
constexpr double kNoJump = 1e-3;          // rad or m

bool is_zero(const MeasuredRow& row) {
  return std::all_of(row.values.begin(), row.values.end(), [](double value) { return value == 0.0; });
}

}  // namespace

std::int64_t RowMemory::add(const MeasuredRow& row, std::int64_t index) {
  entries_.resize(kRows);
  const std::uint64_t hash = hash_of(row);
  const Entry before = std::exchange(entries_[hash % kRows], {hash, index});
  return before.hash == hash ? before.index : -1;
}

std::int64_t RowMemory::find(const MeasuredRow& row) const {
  if (entries_.empty()) return -1;
  const std::uint64_t hash = hash_of(row);
  const Entry& entry = entries_[hash % kRows];
  return entry.hash == hash ? entry.index : -1;
}

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

const std::vector<Joint>& PositionJumps::take(const MeasuredRow& row, double usual_step_s) {
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
      jumped_.push_back(Joint::at(j));
    else
      learn(j);
  }
  return jumped_;
}

std::optional<std::pair<Joint, Joint>> PositionJumps::swapped() const {
  if (jumped_.size() != 2) return {};
  const int a = jumped_[0].index(), b = jumped_[1].index();
  if (jumps(a, b) || jumps(b, a)) return {};
  return std::pair{jumped_[0], jumped_[1]};
}

bool StoppedRecorder::moves_within(double seconds) const {
  if (!last_.has_velocity) return false;
  int moving = 0;
  for (int j = 0; j < last_.joints; ++j) moving += std::abs(last_.dq(j)) * seconds > kMoved;
  return moving >= (last_.has_torque ? 1 : 2);
}

bool StoppedRecorder::becomes_blank(const MeasuredRow& row) const {
  if (last_.values.size() != row.values.size() || row.values.size() < 2 || !is_zero(row)) return false;
  for (int j = 0; j < row.joints; ++j) {
    const double speed = row.has_velocity ? std::abs(last_.dq(j)) : 0.0;
    if (std::abs(last_.q(j)) > kFaster * speed * (row.t - last_.t) + kNoJump) return true;
  }
  return false;
}

RecorderState StoppedRecorder::repeated(const MeasuredRow& row) {
  ++repeats_;
  last_.t = row.t;
  const bool decided = state_ == RecorderState::froze || (state_ == RecorderState::runs && repeats_ > 1);
  if (decided) return state_;
  const double stood_s = row.t - since_;
  const double least_s = std::max(kShortestStop_s, kLongerThanUsual * usual_hold_s_);
  if (repeats_ >= kFewestRepeats && stood_s >= least_s)
    state_ = moves_within(stood_s) ? RecorderState::froze : RecorderState::runs;
  else
    state_ = repeats_ > kMostUndecided ? RecorderState::runs : RecorderState::undecided;
  return state_;
}

RecorderState StoppedRecorder::take(const MeasuredRow& row) {
  if (state_ == RecorderState::blank && is_zero(row)) return state_;
  if (state_ != RecorderState::blank && row.values == last_.values)
    return repeated(row);  // never for a row with a missing value
  if (becomes_blank(row)) return state_ = RecorderState::blank;
  if (repeats_ > 0 && state_ == RecorderState::undecided)
    usual_hold_s_ = std::max(usual_hold_s_, last_.t - since_);
  last_ = row;
  since_ = row.t;
  repeats_ = 0;
  return state_ = RecorderState::runs;
}

}  // namespace faultline
