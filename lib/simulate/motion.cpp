// SPDX-License-Identifier: MIT
#include "lib/simulate/motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/random.hpp"
#include "lib/simulate/joint_list.hpp"

namespace faultline {
namespace {

/// Returns `given`, or the paper's bench ranges if it is empty.
std::vector<double> range_end(const Robot& robot, const std::vector<double>& given, const char* key,
                              bool high) {
  check_count(robot.joints(), given, key);
  if (!given.empty()) return given;
  std::vector<double> ends;
  for (const JointGeometry& joint : robot.chain.geometry)
    ends.push_back(joint.kind == AxisKind::revolute ? (high ? 2.0 : -2.0) : (high ? 0.05 : -0.35));
  return ends;
}

/// Returns the ranges of the points. Throws Error(usage) if `spec` does not fit the robot's joints.
JointRanges checked_ranges(const Robot& robot, const MotionSpec& spec) {
  const JointRanges ranges{range_end(robot, spec.low, "motion.low", false),
                           range_end(robot, spec.high, "motion.high", true)};
  for (int i = 0; i < robot.joints(); ++i)
    if (!(ranges.low[i] <= ranges.high[i]))
      bad_value("motion.low",
                fmt::format("{} of joint {} is above high, {}", ranges.low[i], Joint::at(i), ranges.high[i]));
  if (!(spec.move_min_s > 0.0 && spec.move_min_s <= spec.move_max_s))
    bad_value("motion.move_s", fmt::format("expected 0 < shortest <= longest, found {} and {}",
                                           spec.move_min_s, spec.move_max_s));
  if (!(spec.dwell_min_s >= 0.0 && spec.dwell_min_s <= spec.dwell_max_s))
    bad_value("motion.dwell_s", fmt::format("expected 0 <= shortest <= longest, found {} and {}",
                                            spec.dwell_min_s, spec.dwell_max_s));
  if (!(spec.blend > 0.0 && spec.blend <= 0.5))
    bad_value("motion.blend", fmt::format("expected 0 to 0.5, found {}", spec.blend));
  if (spec.harmonics < 1 || !(spec.fourier_period_s > 0.0))
    bad_value("motion.harmonics", "expected at least one harmonic and a positive period");
  for (const auto& point : spec.points)
    if (static_cast<int>(point.size()) != robot.joints())
      bad_value("motion.points",
                fmt::format("expected points of {} numbers, found {}", robot.joints(), point.size()));
  return ranges;
}

/// Throws Error(usage) if the samples are no motion of this robot.
void check_replay(const Robot& robot, const SampledMotion& replay) {
  const auto n = static_cast<std::size_t>(robot.joints());
  if (!(replay.period_s > 0.0)) bad_value("motion.replay", "expected samples with a positive period");
  if (replay.q.size() != n || replay.dq.size() != n || replay.q[0].size() < 2)
    bad_value("motion.replay", fmt::format("expected q and dq of {} joints with at least 2 samples", n));
  for (std::size_t i = 0; i < n; ++i)
    if (replay.q[i].size() != replay.q[0].size() || replay.dq[i].size() != replay.q[0].size())
      bad_value("motion.replay", "the columns differ in length");
}

/// Path parameter of a move and its derivatives over x = time / duration of the move.
struct Path {
  double s = 1.0, ds = 0.0, dds = 0.0;
};

Path quintic(double x) {
  return {x * x * x * (10.0 + x * (-15.0 + 6.0 * x)), 30.0 * x * x * (1.0 + x * (-2.0 + x)),
          60.0 * x * (1.0 + x * (-3.0 + 2.0 * x))};
}

Path trapezoid(double x, double blend) {
  const double speed = 1.0 / (1.0 - blend), rate = speed / blend;
  if (x < blend) return {0.5 * rate * x * x, rate * x, rate};
  if (x <= 1.0 - blend) return {speed * (x - 0.5 * blend), speed, 0.0};
  const double left = 1.0 - x;
  return {1.0 - 0.5 * rate * left * left, rate * left, -rate};
}

}  // namespace

Motion::Motion(const Robot& robot, const MotionSpec& spec, double duration_s, std::uint64_t seed)
    : joints_(robot.joints()), profile_(spec.profile), blend_(spec.blend) {
  if (profile_ == MotionProfile::replay) {
    check_replay(robot, spec.replay);
    replay_ = spec.replay;
    return;
  }
  const JointRanges ranges = checked_ranges(robot, spec);
  if (profile_ == MotionProfile::fourier)
    plan_harmonics(spec, ranges, seed);
  else
    plan_moves(spec, ranges, duration_s, seed);
}

void Motion::plan_moves(const MotionSpec& spec, const JointRanges& ranges, double duration_s,
                        std::uint64_t seed) {
  Random random(seed);
  std::size_t visited = 0;
  const auto next_point = [&] {
    JointVector point(joints_);
    for (int i = 0; i < joints_; ++i)
      point[i] = spec.points.empty() ? random.uniform(ranges.low[i], ranges.high[i])
                                     : spec.points[visited % spec.points.size()][i];
    ++visited;
    return point;
  };
  JointVector from = next_point();
  double t = random.uniform(spec.dwell_min_s, spec.dwell_max_s);
  do {
    Move move{t, random.uniform(spec.move_min_s, spec.move_max_s), from, next_point()};
    t += move.length_s + random.uniform(spec.dwell_min_s, spec.dwell_max_s);
    from = move.to;
    moves_.push_back(std::move(move));
  } while (t < duration_s);
}

/// Draws random harmonics of falling amplitude, scaled so that they fill the joint's range; the first sine
/// gets the slope with which the period starts at rest.
void Motion::plan_harmonics(const MotionSpec& spec, const JointRanges& ranges, std::uint64_t seed) {
  Random random(seed);
  base_rate_ = 2.0 * std::numbers::pi / spec.fourier_period_s;
  centre_.resize(joints_);
  harmonics_.assign(spec.harmonics, {JointVector::Zero(joints_), JointVector::Zero(joints_)});
  for (int i = 0; i < joints_; ++i) {
    double slope = 0.0;
    for (int k = 0; k < spec.harmonics; ++k) {
      harmonics_[k].cosine[i] = random.normal() / (k + 1);
      if (k > 0) harmonics_[k].sine[i] = random.normal() / (k + 1);
      slope += (k + 1) * harmonics_[k].sine[i];
    }
    harmonics_[0].sine[i] = -slope;  // at rest at the period's start
    double least = 0.0, most = 0.0;
    for (int step = 0; step < 400; ++step) {
      double value = 0.0;
      for (int k = 0; k < spec.harmonics; ++k) {
        const double angle = 2.0 * std::numbers::pi * (k + 1) * step / 400.0;
        const auto [sine, cosine] = elementary::sin_cos(angle);
        value += harmonics_[k].cosine[i] * cosine + harmonics_[k].sine[i] * sine;
      }
      least = step ? std::min(least, value) : value;
      most = step ? std::max(most, value) : value;
    }
    const double scale = most > least ? (ranges.high[i] - ranges.low[i]) / (most - least) : 0.0;
    for (Harmonic& harmonic : harmonics_) {
      harmonic.cosine[i] *= scale;
      harmonic.sine[i] *= scale;
    }
    centre_[i] = ranges.low[i] - scale * least;
  }
}

void Motion::at(double t, Reference& reference) const {
  reference.q.resize(joints_);
  reference.dq.resize(joints_);
  reference.ddq.resize(joints_);
  switch (profile_) {
    case MotionProfile::fourier:
      return harmonics_at(t, reference);
    case MotionProfile::replay:
      return replay_at(t, reference);
    case MotionProfile::quintic:
    case MotionProfile::trapezoidal:
    case MotionProfile::step:
      return move_at(t, reference);
  }
}

void Motion::move_at(double t, Reference& reference) const {
  const auto after = std::upper_bound(moves_.begin(), moves_.end(), t,
                                      [](double time, const Move& move) { return time < move.start_s; });
  reference.dq.setZero();
  reference.ddq.setZero();
  if (after == moves_.begin()) {
    reference.q = moves_.front().from;
    return;
  }
  const Move& move = *(after - 1);
  const double x = (t - move.start_s) / move.length_s;
  reference.q = move.to;
  if (x >= 1.0 || profile_ == MotionProfile::step) return;
  const Path path = profile_ == MotionProfile::quintic ? quintic(x) : trapezoid(x, blend_);
  const double rate = 1.0 / move.length_s;
  for (int i = 0; i < joints_; ++i) {
    const double way = move.to[i] - move.from[i];
    reference.q[i] = move.from[i] + path.s * way;
    reference.dq[i] = path.ds * rate * way;
    reference.ddq[i] = path.dds * rate * rate * way;
  }
}

void Motion::harmonics_at(double t, Reference& reference) const {
  reference.q = centre_;
  reference.dq.setZero();
  reference.ddq.setZero();
  const auto [s1, c1] = elementary::sin_cos(base_rate_ * t);
  double c = c1, s = s1;
  for (std::size_t k = 0; k < harmonics_.size(); ++k) {
    const double rate = base_rate_ * static_cast<double>(k + 1);
    for (int i = 0; i < joints_; ++i) {
      const double value = harmonics_[k].cosine[i] * c + harmonics_[k].sine[i] * s;
      reference.q[i] += value;
      reference.dq[i] += rate * (harmonics_[k].sine[i] * c - harmonics_[k].cosine[i] * s);
      reference.ddq[i] -= rate * rate * value;
    }
    const double next = c * c1 - s * s1;
    s = s * c1 + c * s1;
    c = next;
  }
}

void Motion::replay_at(double t, Reference& reference) const {
  const auto last = static_cast<double>(replay_.q[0].size() - 1);
  const double place = std::clamp(t / replay_.period_s, 0.0, last);
  const auto k = static_cast<std::size_t>(std::min(std::floor(place), last - 1.0));
  const double x = place - static_cast<double>(k), h = replay_.period_s;
  const bool over = place >= last;
  for (int i = 0; i < joints_; ++i) {
    const double q0 = replay_.q[i][k], q1 = replay_.q[i][k + 1];
    const double v0 = h * replay_.dq[i][k], v1 = h * replay_.dq[i][k + 1];
    const double a = 2.0 * (q0 - q1) + v0 + v1, b = 3.0 * (q1 - q0) - 2.0 * v0 - v1;
    reference.q[i] = q0 + x * (v0 + x * (b + x * a));
    reference.dq[i] = over ? 0.0 : (v0 + x * (2.0 * b + x * 3.0 * a)) / h;
    reference.ddq[i] = over ? 0.0 : (2.0 * b + 6.0 * a * x) / (h * h);
  }
}

}  // namespace faultline
