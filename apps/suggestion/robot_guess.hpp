// SPDX-License-Identifier: MIT
#pragma once

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

}  // namespace faultline
