// SPDX-License-Identifier: MIT
#include "lib/log/recorder/stopped_recorder.hpp"

#include <algorithm>

namespace faultline {
namespace {

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
