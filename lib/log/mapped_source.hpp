// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "lib/log/column_matching.hpp"
#include "lib/log/log_source.hpp"
#include "lib/log/raw_reader.hpp"
#include "lib/log/rows/clean.hpp"
#include "lib/log/rows/sparse.hpp"

namespace faultline {

struct MappedSourceOptions {
  ColumnMap columns{};      ///< [log.columns] of the robot file
  int run = 1;              ///< of a file in which the clock restarts, from 1
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
  const LogIdentity& identity() const override { return reader_->identity(); }
  const Issues& issues() const override;
  double share_read() const override { return reader_->share_read(); }
  const Matching& matching() const { return matching_; }

 private:
  bool fill(Log& segment);
  void take_block(Log& segment);
  void find_epoch();
  void put_waiting_row_first(Log& segment);
  void take(const ChannelSource& source, std::vector<double>& values);
  std::vector<double>& channel_of(Log& log, Channel channel) const;
  void gather_issues() const;
  void refuse_no_rows() const;

  std::unique_ptr<RawReader> reader_;
  MappedSourceOptions options_;
  Matching matching_;
  std::vector<int> uses_;  ///< of each raw column
  RawBlock block_;
  CleanState clean_state_;
  SparseRows sparse_rows_;
  Log waiting_;                         ///< a row whose time could not be judged yet, or none
  std::int64_t segment_first_row_ = 0;  ///< data row of the segment's first row, from 0
  std::int64_t waiting_file_row_ = 0;   ///< data row of the waiting one, from 0
  std::int64_t rows_kept_ = 0;
  bool at_end_ = false;
  bool epoch_found_ = false;  ///< or looked for
  Issues cleaning_issues_;
  mutable Issues issues_;          ///< gathered when asked for
  mutable bool gathered_ = false;  ///< whether issues_ holds all so far
};

}  // namespace faultline
