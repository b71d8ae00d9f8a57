// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "lib/log/channel_names.hpp"
#include "lib/log/channels.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// Stands for a number that was not recorded or cannot be computed.
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A column under its name in the file; unit empty if the file gives none.
struct RawColumn {
  std::string name;
  std::string unit;
  /// The channel that the file itself states, as a ROS JointState does; most files leave that to the name.
  std::optional<Channel> meaning{};
  bool unit_assumed = false;  ///< `unit` was inferred from the values, see counted_time()
};

/// Consecutive rows of a file: one vector of `rows` values for each column. A cell without a number is NaN.
struct RawBlock {
  std::int64_t first_row = 0;  ///< data row of the first one, from 0
  int rows = 0;
  std::vector<std::vector<double>> columns;
};

/// Interface of a file format: named columns of numbers in blocks of bounded size. MappedSource assigns
/// channels and units and checks the order of times.
class RawReader {
 public:
  virtual ~RawReader() = default;
  virtual const std::vector<RawColumn>& columns() const = 0;
  /// Chooses the part of a recording of messages that is the log. To be called first: such a recording has no
  /// columns before. Throws Error(input) for a choice that the recording does not have.
  virtual void choose(const RecordingChoice&) {}
  /// Selects the columns to read; the vectors of the others may be empty. All are selected at first.
  virtual void want(const std::vector<bool>& columns) { wanted_ = columns; }
  /// Reads at most `max_rows` rows into the block, reusing its storage; returns false after the last row.
  virtual bool next(RawBlock& block, int max_rows) = 0;
  virtual void rewind() = 0;
  /// `rows_read` counts the rows handed out and those in issues().rows_dropped().
  const LogIdentity& identity() const { return identity_; }
  /// Issues name a channel by the column name in the file.
  virtual const Issues& issues() const = 0;
  /// Whether the columns are canonical channels in SI already, so that no column map applies.
  virtual bool canonical() const { return false; }
  /// Whether each row holds only some of the signals, as written by programs that merge signals of different
  /// rates; see HeldValue.
  virtual bool sparse() const { return false; }
  /// Returns the share of the file read so far, 0 to 1.
  virtual double share_read() const = 0;

 protected:
  LogIdentity identity_;
  std::vector<bool> wanted_;
};

}  // namespace faultline
