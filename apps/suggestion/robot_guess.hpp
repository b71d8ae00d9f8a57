// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "apps/suggestion/raw_excerpt.hpp"
#include "lib/log/channel_names.hpp"
#include "lib/log/channels.hpp"

namespace faultline {

/// What a column seems to be, and why.
struct GuessedChannel {
  Channel channel;
  int column = -1;  ///< kRowNumber: the row's number
  ColumnSpec spec{};
  std::string reason{};
  int nanoseconds = -1;  ///< second column of a time in seconds and nanoseconds, found by its name
};

struct GuessedAxis {
  bool slides = false;
  std::string reason{};
};

/// A robot and the meaning of its log, as names, units and data suggest.
struct RobotGuess {
  std::vector<GuessedAxis> axes;
  std::vector<GuessedChannel> channels;
  std::string torque = "commanded";
  std::string torque_reason;
  std::vector<std::string> untold;  ///< what could not be told
};

/// Throws Error(input) when no position can be told.
RobotGuess guess_robot(const RawExcerpt& excerpt);

/// The guess as a robot file that says why.
std::string robot_guess_text(const RobotGuess& guess, const RawExcerpt& excerpt);

}  // namespace faultline
