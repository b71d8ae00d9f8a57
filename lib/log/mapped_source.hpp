// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "lib/log/column_matching.hpp"
#include "lib/log/log_source.hpp"
#include "lib/log/raw_reader.hpp"
#include "lib/log/rows/row_order.hpp"
#include "lib/log/rows/sparse.hpp"

namespace faultline {

struct MappedSourceOptions {
  ColumnMap columns{};  ///< [log.columns] of the robot file
  int run = kEveryRun;  ///< of a file in which the clock restarts, from 1; all of them: one after the other
  int segment_rows = 4096;  ///< at most so many rows a segment; changes no byte of any result
  bool keep_extra = true;   ///< hand out columns without a canonical meaning too
};

/// The rows of a file as joint log: columns mapped to channels in SI, rows with unusable time left out.
class MappedSource : public LogSource {
 public:
  /// Throws like match_columns().
  MappedSource(std::unique_ptr<RawReader> reader, const MappedSourceOptions& options);

  /// At the end throws Error(input) when not a single row was usable.
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
  std::vector<double>& channel_of(Log& log, Channel channel) const;
  void gather_issues() const;
  void refuse_no_rows() const;

  std::unique_ptr<RawReader> reader_;
  MappedSourceOptions options_;
  Matching matching_;
  std::vector<int> uses_;  ///< of each raw column
  RawBlock block_;
  RowOrder order_;
  LogIdentity identity_;
  SparseRows sparse_rows_;
  Log rows_;  ///< of a block
  std::int64_t rows_kept_ = 0;
  bool at_end_ = false;
  bool epoch_found_ = false;  ///< or looked for
  Issues cleaning_issues_;
  mutable Issues issues_;          ///< gathered when asked for
  mutable bool gathered_ = false;  ///< whether issues_ holds all so far
};

}  // namespace faultline
