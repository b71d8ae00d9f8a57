// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "lib/log/channel_names.hpp"
#include "lib/log/channels.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// The first rows of a file, unchanged; enough to derive the meaning of its columns.
struct RawExcerpt {
  std::string path;
  bool canonical = false;                   ///< the columns are channels in SI and need no guess
  std::vector<RawColumn> columns;           ///< the first 256
  std::vector<std::vector<double>> values;  ///< [column][row]

  std::size_t rows() const;
};

/// Throws Error(input) when the file cannot be read.
RawExcerpt raw_excerpt(const std::string& path);

/// The probable meaning of a column, and the reason.
struct GuessedChannel {
  Channel channel;
  int column = -1;  ///< kRowNumber: the number of the row
  ColumnSpec spec{};
  std::string reason{};
  int nanoseconds = -1;  ///< second column of a time in seconds and nanoseconds, found by its name
};

struct GuessedAxis {
  bool slides = false;
  std::string reason{};
};

/// A robot and the meaning of its log, derived from names, units and data.
struct RobotGuess {
  std::vector<GuessedAxis> axes;
  std::vector<GuessedChannel> channels;
  std::string torque = "commanded";
  std::string torque_reason;
  std::vector<std::string> untold;  ///< facts that could not be derived
};

/// Throws Error(input) when no position is found.
RobotGuess guess_robot(const RawExcerpt& excerpt);

/// Returns the guess as a robot file with its reasons as comments.
std::string robot_guess_text(const RobotGuess& guess, const RawExcerpt& excerpt);

/// Finds the channel of each column by their names, else by which column is the derivative of which; no units
/// yet. Throws Error(input) when no position is found.
std::vector<GuessedChannel> guess_columns(const RawExcerpt& excerpt);

/// False when name or unit of a column shows another quantity, such as a temperature, a counter, or a
/// velocity if `quantity` is a position.
bool may_be(const RawColumn& column, Quantity quantity);

/// Returns the raw values of the channel; for a time without a column the row numbers.
std::vector<double> values_of(const RawExcerpt& excerpt, const GuessedChannel& guess);

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
  double position_factor = 1.0;  ///< to SI
  bool flipped = false;          ///< one of them has the opposite sign
};

/// Unit of the angles of the log's other joints, according to their values.
enum class OtherAngles { unknown, degrees, radians };

/// Finds the units of one joint; `time_factor` converts its times to s. An empty known unit means that it
/// must be derived from the values.
GuessedUnits guess_joint_units(const JointNumbers& joint, double time_factor,
                               const std::string& known_position, const std::string& known_velocity,
                               OtherAngles others);

}  // namespace faultline
