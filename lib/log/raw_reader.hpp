// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lib/log/channel_names.hpp"
#include "lib/log/channels.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// A column as the file calls it; unit empty when the file does not tell.
struct RawColumn {
  std::string name;
  std::string unit;
  /// What the file says that it is, as a ROS JointState does; most files leave that to the name.
  std::optional<Channel> meaning{};
  bool unit_assumed = false;  ///< the values showed `unit`, see counted_time(), not the file
};

/// Consecutive rows of a file, one vector a column, of `rows` values. A cell without a number is NaN.
struct RawBlock {
  std::int64_t first_row = 0;  ///< data row of the first one, from 0
  int rows = 0;
  std::vector<std::vector<double>> columns;
};

/// What a file format has to offer: named columns of numbers in blocks of bounded size. Channel meaning,
/// units and time order are judged later, by MappedSource.
class RawReader {
 public:
  virtual ~RawReader() = default;
  virtual const std::vector<RawColumn>& columns() const = 0;
  /// Of a recording of messages, which part is the log; before anything else. Its columns may be others then.
  virtual void choose(const RecordingChoice&) {}
  /// Columns that are not wanted need not be read; their vectors are then empty. All are wanted at first.
  virtual void want(const std::vector<bool>& columns) = 0;
  /// At most `max_rows` rows, in the block's own storage; false after the last row.
  virtual bool next(RawBlock& block, int max_rows) = 0;
  virtual void rewind() = 0;
  /// `rows_read` counts the rows handed out and those in issues().rows_dropped().
  virtual const LogIdentity& identity() const = 0;
  /// Channels are named as the file names its columns.
  virtual const Issues& issues() const = 0;
  /// True when the columns are canonical channels in SI already, so that no column map applies.
  virtual bool canonical() const { return false; }
  /// True when rows hold some of the signals only, see SparseRows.
  virtual bool sparse() const { return false; }
  /// Share of the file read so far, 0 to 1.
  virtual double share_read() const = 0;
};

}  // namespace faultline
