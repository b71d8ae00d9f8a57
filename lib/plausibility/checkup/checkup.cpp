// SPDX-License-Identifier: MIT
#include "lib/plausibility/checkup/checkup.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lib/log/log.hpp"
#include "lib/log/time_axis.hpp"

namespace faultline {
namespace {

constexpr std::int64_t kShort = 20;  // rows, of a source slower than the logger; a robot at rest repeats more

constexpr std::size_t kBlockSteps = 64;
constexpr std::ptrdiff_t kTrimmed = 8;  // at each end
constexpr std::size_t kBlocksForGood = 3;
constexpr double kOther = 0.2;      // relative, of a period from the usual one
constexpr double kSamePace = 0.05;  // relative, of the new periods from each other
constexpr double kAdaption = 0.1;
constexpr std::size_t kMostChanges = 100;

bool differs(double a, double b, double share) { return std::abs(a - b) > share * b; }

constexpr int kHeadRows = 64;

}  // namespace

void RepeatedRowCheck::Runs::end() {
  found.longest = std::max(found.longest, run);
  if (run > 0 && run < kShort) {
    if (found.first_row == 0) found.first_row = row - run + 1;
    found.held += run;
  }
  run = 0;
}

void RepeatedRowCheck::Runs::take(bool repeats) {
  if (repeats) {
    ++found.rows;
    ++run;
  } else {
    end();
  }
  ++row;
}

void RepeatedRowCheck::add(const Log& segment) {
  const std::size_t positions = segment.q.size();  // the first channels
  for (int i = 0; i < segment.rows(); ++i) {
    now_.clear();
    for_each_joint_channel(segment,
                           [&](const std::vector<double>& values, Channel) { now_.push_back(values[i]); });
    const bool known = last_.size() == now_.size();  // a missing value equals no value
    std::size_t same = 0;
    for (std::size_t j = 0; j < positions && known; ++j) same += now_[j] == last_[j];
    positions_.take(known && same == positions);
    mixed_ += same > 0 && same < positions;
    all_.take(now_ == last_);
    now_.swap(last_);
  }
}

RepeatedRowCounts RepeatedRowCheck::result() const {
  RepeatedRowCheck done = *this;
  done.all_.end();
  done.positions_.end();
  return {done.all_.found, done.positions_.found, mixed_};
}

void ClockCheck::add(double t) {
  if (rows_++ > 0) {
    if (steps_.empty()) block_ = {last_s_, rows_ - 1, 0.0};
    steps_.push_back(t - last_s_);
    if (steps_.size() == kBlockSteps) close_block();
  }
  last_s_ = t;
}

void ClockCheck::close_block() {
  std::sort(steps_.begin(), steps_.end());
  block_.period_s = std::accumulate(steps_.begin() + kTrimmed, steps_.end() - kTrimmed, 0.0) /
                    static_cast<double>(kBlockSteps - 2 * kTrimmed);
  steps_.clear();
  if (usual_s_ == 0.0) usual_s_ = block_.period_s;
  if (!differs(block_.period_s, usual_s_, kOther)) {
    usual_s_ += kAdaption * (block_.period_s - usual_s_);
    other_.clear();
    return;
  }
  // The block in which the period changes has steps of both periods.
  if (other_.size() > 1 && differs(block_.period_s, other_.back().period_s, kSamePace)) other_.clear();
  other_.push_back(block_);
  if (other_.size() <= kBlocksForGood) return;
  if (changes_.size() < kMostChanges)
    changes_.push_back({other_.front().start_s, other_.front().row, usual_s_, block_.period_s});
  usual_s_ = block_.period_s;
  other_.clear();
}

void Checkup::add(const Log& segment) {
  if (settled_) return take(segment);
  append(head_, segment);
  if (head_.rows() > kHeadRows) settle();
}

void Checkup::settle() {
  settled_ = true;
  const int head = std::min(head_.rows(), kHeadRows);
  const double step = median_step({head_.time.begin(), head_.time.begin() + head});
  const double period_s = step > 0.0 ? step : 1.0;
  for_each_joint_channel(head_, [&](const std::vector<double>&, Channel channel) {
    channels_.push_back(channel);
    courses_.emplace_back(channel.quantity == Quantity::dq);
  });
  const auto joints = static_cast<std::size_t>(head_.joints());
  velocity_.assign(head_.dq.empty() ? 0 : joints, VelocityRelation(period_s));
  if (!head_.tau.empty() && head_.joints() <= TorqueRelation::kMostJoints)
    torque_.emplace(head_.joints(), period_s);
  paths_.resize(joints);
  places_.resize(joints);
  take(head_);
  head_ = {};
}

/// Adds samples of a joint, and integrates its velocity (missing: 0) to its places; NaN without velocities.
void Checkup::take_joint(const Log& segment, std::size_t j) {
  Path& path = paths_[j];
  auto& places = places_[j];
  places.assign(segment.time.size(), std::nan(""));
  if (segment.dq.empty()) return;
  for (std::size_t i = 0; i < segment.time.size(); ++i) {
    const double t = segment.time[i], dq = segment.dq[j][i];
    const double known = std::isnan(dq) ? 0.0 : dq;
    if (path.begun) path.place += 0.5 * (known + path.dq) * (t - path.t);
    path = {path.place, t, known, true};
    places[i] = path.place;
    velocity_[j].add(t, segment.q[j][i], dq);
  }
}

void Checkup::take(const Log& segment) {
  for (const double t : segment.time) clock_.add(t);
  repeated_.add(segment);
  for (std::size_t j = 0; j < paths_.size(); ++j) take_joint(segment, j);
  if (torque_)
    for (std::size_t i = 0; i < segment.time.size(); ++i)
      torque_->add(segment.time[i], segment.q, segment.tau, i);
  std::size_t at = 0;
  for_each_joint_channel(segment, [&](const std::vector<double>& values, Channel channel) {
    const int j = channel.joint.index();
    const auto& places = channel.quantity == Quantity::q ? places_[j] : segment.q[j];
    ChannelCourse& course = courses_[at++];
    for (std::size_t i = 0; i < values.size(); ++i) course.add(segment.time[i], values[i], places[i]);
  });
}

CheckupResult Checkup::result() const {
  if (!settled_ && head_.rows() > 0) {
    Checkup done = *this;
    done.settle();
    return done.result();
  }
  CheckupResult result;
  for (std::size_t i = 0; i < channels_.size(); ++i)
    result.channels.push_back({channels_[i], courses_[i].result()});
  result.joints.resize(paths_.size());
  for (std::size_t j = 0; j < velocity_.size(); ++j) result.joints[j].velocity = velocity_[j].result();
  if (torque_) {
    const auto torques = torque_->result();
    for (std::size_t j = 0; j < torques.size(); ++j) result.joints[j].torque = torques[j];
  }
  result.clock_changes = clock_.changes();
  result.repeated = repeated_.result();
  return result;
}

const ChannelCheckup* CheckupResult::find(Channel channel) const {
  const auto found = std::find_if(channels.begin(), channels.end(),
                                  [&](const ChannelCheckup& one) { return one.channel == channel; });
  return found == channels.end() ? nullptr : &*found;
}

}  // namespace faultline
