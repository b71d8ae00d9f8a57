// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace faultline {

/// What the numbers of one joint's columns tell of their units.
struct JointNumbers {
  double span = 0.0;     ///< of the position
  double largest = 0.0;  ///< position's magnitude
  double path = 0.0;     ///< that the position went, noise left out
  double fastest = 0.0;  ///< velocity's magnitude; 0 without
  /// Change of position over the velocity's integral, times as logged; NaN without velocity or motion.
  double ratio = std::numeric_limits<double>::quiet_NaN();
  /// Correlation of velocity and torque, whose mean is left out; NaN without one of them.
  double power = std::numeric_limits<double>::quiet_NaN();
  bool carries = false;  ///< the torque is far from zero on average, as where it carries a weight
};

JointNumbers joint_numbers(const std::vector<double>& time, const std::vector<double>& q,
                           const std::vector<double>& dq, const std::vector<double>& tau);

struct GuessedUnit {
  std::string unit{};  ///< empty: SI
  std::string reason{};
};

/// Of stamps without a unit; `units` of positions and velocities are not needed, for ratios of all usual ones
/// are tried.
GuessedUnit guess_time_unit(const std::vector<double>& time, const std::vector<JointNumbers>& joints);

struct GuessedUnits {
  GuessedUnit position, velocity;
  double position_factor = 1.0, velocity_factor = 1.0;  ///< to SI
  bool flipped = false;                                 ///< one of them has the other sign
};

/// Angles that the other joints of a log are in, by their numbers.
enum class OtherAngles { unknown, degrees, radians };

/// Of one joint whose header says nothing; `time_factor` brings its times to s. An empty `known` unit of the
/// position means that it is to be guessed.
GuessedUnits guess_joint_units(const JointNumbers& joint, double time_factor,
                               const std::string& known_position, const std::string& known_velocity,
                               OtherAngles others);

}  // namespace faultline
