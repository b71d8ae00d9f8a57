// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lib/log/channel_names.hpp"
#include "lib/log/channels.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// Stands for a number that was not recorded or cannot be computed.
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Least number that stands for a text: beyond what controllers log, and a power of 2.
inline constexpr double kLeastTextCode = 0x1p200;
/// Returns a number that stands for a text, the same for equal texts; unlike texts almost never share one.
inline double text_code(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  constexpr int kMantissaBits = 52, kHashBits = 64;
  return kLeastTextCode * (1.0 + static_cast<double>(hash >> (kHashBits - kMantissaBits)) /
                                     static_cast<double>(std::uint64_t{1} << kMantissaBits));
}
/// Whether a number stands for a text.
inline bool is_text_code(double value) { return value >= kLeastTextCode && value < 2.0 * kLeastTextCode; }

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
  /// Makes the cells of a column that are texts numbers: text_code() of each. Without this, and in formats
  /// without texts, they are NaN. To be called before the first row is read.
  virtual void code_texts(int /*column*/) {}
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
