// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/log/column_matching.hpp"
#include "lib/log/log.hpp"
#include "lib/log/log_source.hpp"
#include "lib/log/raw_reader.hpp"
#include "lib/log/rows/row_order.hpp"

namespace faultline {

/// The latest value of a signal in a table in which each row holds only some of the signals.
struct HeldValue {
  double value = std::numeric_limits<double>::quiet_NaN();
  double since_s = -std::numeric_limits<double>::infinity();
  int rows = 0;  ///< rows without a value since then
};

struct MappedSourceOptions {
  ColumnMap columns{};  ///< [log.columns] of the robot file
  int run = kEveryRun;  ///< run to read, from 1, if the clock restarts; kEveryRun: all, one after the other
  int segment_rows = 4096;            ///< most rows of a segment; has no effect on any result
  bool keep_extra = true;             ///< whether columns without a canonical meaning are handed out
  bool keep_partial_velocity = true;  ///< whether velocities are handed out that some joints lack
};

/// The rows of a file as a joint log: columns mapped to channels in SI, rows without a usable time dropped.
class MappedSource : public LogSource {
 public:
  /// Throws like match_columns().
  MappedSource(std::unique_ptr<RawReader> reader, const MappedSourceOptions& options);

  /// Throws Error(input) at the end if no row was usable.
  bool next(Log& segment) override;
  void rewind() override;
  const LogIdentity& identity() const override { return identity_; }
  const Issues& issues() const override;
  double share_read() const override { return reader_->share_read(); }
  const Matching& matching() const { return matching_; }

 private:
  bool fill();
  void take_block(Log& segment);
  void find_epoch();
  void take(const ChannelSource& source, std::vector<double>& values);
  void gather_sparse_rows(Log& segment);
  void gather_issues() const;
  void refuse_no_rows() const;
  LogIdentity identity_of_columns() const;

  std::unique_ptr<RawReader> reader_;
  MappedSourceOptions options_;
  Matching matching_;
  std::vector<int> uses_;  ///< number of uses of each raw column
  RawBlock block_;
  RowOrder order_;
  LogIdentity identity_;
  std::vector<HeldValue> held_;  ///< by channel, if the rows are sparse
  Log rows_;                     ///< rows of a block
  std::int64_t rows_kept_ = 0;
  bool at_end_ = false;
  bool epoch_found_ = false;  ///< true once find_epoch() has run
  Issues cleaning_issues_;
  mutable Issues issues_;          ///< gathered on demand
  mutable bool gathered_ = false;  ///< whether issues_ is up to date
};

}  // namespace faultline
