// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "lib/log/log.hpp"
#include "lib/reproduce/filter/fault_load.hpp"
#include "lib/reproduce/filter/log_noise.hpp"
#include "lib/reproduce/filter/prediction.hpp"

namespace faultline {

/// A row of the log as the filters see it, with what the healthy filter made of it.
struct FollowedSample {
  std::int64_t row = 0;
  double time = 0.0;  ///< s
  double dt = 0.0;    ///< s since the sample before; 0 where the filter started anew
  JointArray q;       ///< NaN where nothing was measured
  JointArray dq;
  JointArray q_std;  ///< measurement noise of this sample
  JointArray dq_std;
  JointArray q_tail;  ///< standard deviations of an innovation that count in full
  JointArray dq_tail;
  JointArray torque;          ///< held over from the sample before where it is missing
  JointArray drive_level;     ///< torque at the step before without its quick part, which answers noise
  JointFlags torque_missing;  ///< nobody knows what the drive did around this sample
  JointFlags repeats;         ///< position and velocity equal the sample before, bit for bit
  /// Joints outside the range known to be healthy that do not move outward: an end stop, a cable or a table
  /// may hold them, so their readings count for no hypothesis.
  JointFlags pressed;
  bool in_range = true;       ///< no joint is outside that range, whichever way it moves
  JointArray log_likelihood;  ///< of each joint's channels given the healthy past, chi-square capped
  JointArray chi_square;      ///< of each joint's channels, capped
  std::array<double, 2 * kMaxJoints> whitened;  ///< innovations over their standard deviation: q then dq
  double total_log_likelihood = 0.0;
  GaussianState posterior;

  bool lacks_torque(int joints) const {
    return std::any_of(torque_missing.begin(), torque_missing.begin() + joints, [](bool it) { return it; });
  }

  FollowedSample() {}  // NOLINT: leaves the large arrays unset until a row fills them
};

/// The step that ends at a sample.
Step step_to(const FollowedSample& at, const JointArray& torque_before, const JointFlags& missing_before);

/// Largest chi-square that one measured number may contribute, so that a single wild value decides nothing.
inline constexpr double kChiSquareCap = 36.0;

/// Every innovation counts in full, however far it strays.
inline constexpr double kNoTail = std::numeric_limits<double>::infinity();

/// Observes the measured channels of joint j.
struct JointObservation {
  double log_likelihood = 0.0;
  double chi_square = 0.0;
  double whitened_q = 0.0;
  double whitened_dq = 0.0;
};
JointObservation observe_joint(GaussianState& state, int joints, const FollowedSample& sample, int j,
                               const SensorError& error = {});

/// A sensor of coarse codes errs alike for as long as it shows the same one or two of them, as at rest: after
/// the first few, all these rows together say as much as one.
class RepeatedCodes {
 public:
  /// The next reading of joint j; NaN for none.
  void take(int j, double reading);
  /// Times the standard deviation of one reading.
  double noise_factor(int j) const;

 private:
  JointArray last_{}, other_{}, rows_{};
};

/// Follows a log with the healthy filter, row by row; its state crosses segment borders.
class Follower {
 public:
  explicit Follower(const MotionModel& model, const LogNoise& noise = {});
  Follower(const Follower&) = delete;
  Follower& operator=(const Follower&) = delete;

  /// Takes row `row` of the segment and fills `out`.
  void follow(const Log& segment, int row, FollowedSample& out);
  const FaultDynamics& dynamics() const { return dynamics_; }

 private:
  bool is_pressed(const FollowedSample& sample, int j) const;
  void read_row(const Log& segment, int row, FollowedSample& out) const;
  void start(FollowedSample& out);
  void restart_slow_states(double gap_s);
  double step_to_stamp(const FollowedSample& out);
  double step_in_periods(double since, double periods) const;
  double log_likelihood_of_stamp(double since, double periods) const;
  void set_clock(double since, double step);
  struct RowFit {
    double log_likelihood = 0.0;
    JointArray chi_square{};
  };
  bool tells(const RowFit& likelier, const RowFit& other) const;
  double periods_by_motion(const FollowedSample& out, double since, double by_stamp) const;
  bool is_elsewhere(const FollowedSample& out, double dt) const;
  RowFit fit_after(const FollowedSample& out, double dt) const;
  void guess_unknown_speed(const FollowedSample& out);
  void keep_some_mass();
  void set_measurement_noise(const GaussianState& state, const JointArray& speed_before,
                             FollowedSample& out) const;

  const MotionModel& model_;
  LogNoise noise_;
  FaultDynamics dynamics_;
  GaussianState state_;
  bool started_ = false;
  double last_time_ = 0.0;
  double usual_dt_ = 0.0;
  double clock_ = 0.0;           ///< s: when the last row was taken, as far as its stamp can be believed
  double clock_rows_ = 1.0;      ///< that carried information about its position
  double wobble_ = 0.04;         ///< variance of the stamps against it, of late, in squared periods
  int rows_without_torque_ = 0;  ///< of a joint at least, up to the last row
  JointFlags last_torque_missing_{};
  JointFlags
      speed_unknown_{};  ///< nothing was ever seen of it: the first row after a start without velocities
  JointArray last_q_{}, last_dq_{}, last_torque_{}, drive_level_{};
  RepeatedCodes q_codes_;
  JointArray low_{}, high_{};  ///< healthy range, widened by what this log visits
};

}  // namespace faultline
