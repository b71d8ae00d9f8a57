// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/log/channel_names.hpp"
#include "lib/log/channels.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// How a canonical channel is made from a raw column: value = gain * raw + offset.
struct ChannelSource {
  Channel channel;
  int column = -1;              ///< kRowNumber: the row's number from 0 stands for the raw value
  int nanoseconds_column = -1;  ///< second column of a time in seconds and nanoseconds; -1 for none
  double gain = 1.0;
  double offset = 0.0;

  bool unchanged() const { return gain == 1.0 && offset == 0.0 && nanoseconds_column < 0; }
};
inline constexpr int kRowNumber = -2;
/// Column name in a ColumnSpec that stands for the row's number; with `scale` as sample period it gives a
/// time to a log that has none.
inline constexpr const char* kRowNumberName = "@row";

/// Which columns of a file become which channels. `joints` is the number of positions found.
struct Matching {
  int joints = 0;
  std::vector<ChannelSource> channels;  ///< time first, then by quantity and joint
  std::vector<int> extra;               ///< columns without a canonical meaning
  Issues issues;                        ///< ambiguous or incomplete channels
};

/// Finds the channels by the column map, else by canonical name, else by the usual names. Throws Error(input)
/// when the time or any position is missing (naming the columns there are and the line of [log.columns] that
/// would map one), and Error(usage) for a unit that is not known or a sign that is not +1 or -1.
Matching match_columns(const std::vector<RawColumn>& columns, const ColumnMap& map, const std::string& path);

/// Empty when match_columns() would succeed, else its error message.
std::string why_no_match(const std::vector<RawColumn>& columns, const ColumnMap& map,
                         const std::string& path);

}  // namespace faultline
