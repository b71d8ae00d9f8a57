// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace faultline {

/// Statistics of one joint's columns from which their units are derived.
struct JointNumbers {
  double span = 0.0;     ///< of the position
  double largest = 0.0;  ///< magnitude of the position
  double path = 0.0;     ///< path length of the position, without changes below 5 % of the span
  double fastest = 0.0;  ///< magnitude of the velocity; 0 without
  /// Change of position divided by the integral of velocity, times as logged; NaN without velocity or motion.
  double ratio = std::numeric_limits<double>::quiet_NaN();
  /// Correlation of velocity and torque after its mean is removed; NaN without one of them.
  double power = std::numeric_limits<double>::quiet_NaN();
  bool carries = false;  ///< the mean torque is far from zero, as for a joint that carries a weight
};

JointNumbers joint_numbers(const std::vector<double>& time, const std::vector<double>& q,
                           const std::vector<double>& dq, const std::vector<double>& tau);

struct GuessedUnit {
  std::string unit{};  ///< empty: SI
  std::string reason{};
};

/// Finds the unit of times without one. The units of positions and velocities are not needed, as the usual
/// ratios are tried.
GuessedUnit guess_time_unit(const std::vector<double>& time, const std::vector<JointNumbers>& joints);

struct GuessedUnits {
  GuessedUnit position, velocity;
  double position_factor = 1.0, velocity_factor = 1.0;  ///< to SI
  bool flipped = false;                                 ///< one of them has the opposite sign
};

/// Unit of the angles of the log's other joints, according to their values.
enum class OtherAngles { unknown, degrees, radians };

/// Finds the units of one joint; `time_factor` converts its times to s. An empty known unit means that it
/// must be derived from the values.
GuessedUnits guess_joint_units(const JointNumbers& joint, double time_factor,
                               const std::string& known_position, const std::string& known_velocity,
                               OtherAngles others);

}  // namespace faultline
