// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "lib/log/log.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

enum class MotionProfile {
  quintic,      ///< point to point, velocity and acceleration zero at both ends
  trapezoidal,  ///< point to point, constant acceleration, speed, deceleration
  step,         ///< the set-point jumps to the next point and stays
  fourier,      ///< sum of harmonics, all joints at once, starts and ends each period at rest
  replay,       ///< follows `MotionSpec::replay`
};

/// A motion as samples at a constant period, with cubic Hermite interpolation between them.
struct SampledMotion {
  double period_s = 0.0;
  JointSignals q;
  JointSignals dq;
};

/// The motion that the robot is to follow. Points of point-to-point motions are drawn uniformly within the
/// joint ranges.
struct MotionSpec {
  MotionProfile profile = MotionProfile::quintic;
  /// Joint ranges, rad or m; empty: -2 to 2 rad, -0.35 to 0.05 m.
  std::vector<double> low{};
  std::vector<double> high{};
  double move_min_s = 1.2;  ///< duration of one move, drawn uniformly
  double move_max_s = 1.8;
  double dwell_min_s = 0.2;  ///< rest after each move
  double dwell_max_s = 0.6;
  double blend = 0.25;  ///< trapezoidal: share of the move spent on acceleration, at most 0.5
  /// Points to visit in turn, then again from the first, [point][joint]; empty: drawn at random.
  std::vector<std::vector<double>> points{};
  int harmonics = 5;              ///< fourier
  double fourier_period_s = 8.0;  ///< fourier: period of the first harmonic
  SampledMotion replay{};
};

/// Ends of the joints' ranges, rad or m.
struct JointRanges {
  std::vector<double> low, high;
};

/// The reference at one moment.
struct Reference {
  JointVector q, dq, ddq;
};

/// The reference trajectory of one run, a function of time.
class Motion {
 public:
  /// Throws Error(usage) if `spec` does not fit a robot with these joints.
  Motion(const Robot& robot, const MotionSpec& spec, double duration_s, std::uint64_t seed);

  /// Sets all of `reference`; t >= 0. The robot rests after the last planned move.
  void at(double t, Reference& reference) const;

 private:
  struct Move {
    double start_s = 0.0;
    double length_s = 0.0;
    JointVector from, to;
  };
  struct Harmonic {
    JointVector sine, cosine;
  };

  void plan_moves(const MotionSpec& spec, const JointRanges& ranges, double duration_s, std::uint64_t seed);
  void plan_harmonics(const MotionSpec& spec, const JointRanges& ranges, std::uint64_t seed);
  void move_at(double t, Reference& reference) const;
  void harmonics_at(double t, Reference& reference) const;
  void replay_at(double t, Reference& reference) const;

  int joints_ = 0;
  MotionProfile profile_ = MotionProfile::quintic;
  double blend_ = 0.25;
  std::vector<Move> moves_;
  std::vector<Harmonic> harmonics_;
  JointVector centre_;
  double base_rate_ = 0.0;  ///< rad/s of the first harmonic
  SampledMotion replay_;
};

}  // namespace faultline
