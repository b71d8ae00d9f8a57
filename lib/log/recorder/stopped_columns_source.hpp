// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "lib/log/log_source.hpp"
#include "lib/log/recorder/stopped_columns.hpp"

namespace faultline {

/// A log in which what a recorder did not measure is missing: positions, velocities or torques of all joints
/// in which it stood still while the others went on (positions_stopped, velocities_stopped, torques_stopped).
class StoppedColumnsSource : public LogSource {
 public:
  explicit StoppedColumnsSource(std::unique_ptr<LogSource> source) : source_(std::move(source)) {}

  bool next(Log& segment) override;
  void rewind() override;
  const LogIdentity& identity() const override { return source_->identity(); }
  const Issues& issues() const override;
  double share_read() const override { return source_->share_read(); }

 private:
  void judge_rows();
  void empty_held(ColumnGroup group, const ColumnHold& hold, int up_to);
  int settled() const;

  std::unique_ptr<LogSource> source_;
  StoppedColumns columns_;
  std::array<ColumnHold, kColumnGroups> holds_;
  Log rows_;                     ///< not handed out yet; first_row as the source counts
  int judged_ = 0;               ///< of these
  std::int64_t handed_out_ = 0;  ///< rows before these
  bool at_end_ = false;
  Issues found_;
  mutable Issues issues_;
};

}  // namespace faultline
