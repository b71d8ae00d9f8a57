// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/parts/raw_time.hpp"
#include "lib/core/issue.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// A file that is joined to another: gives the values that belong to the rows of that one, asked for in
/// order.
class Partner {
 public:
  /// By time when `time` says where the file has it, else by row.
  Partner(std::unique_ptr<RawReader> reader, std::optional<RawTime> time);

  const RawReader& reader() const { return *reader_; }
  RawReader& reader() { return *reader_; }
  /// Writes the values of the file's columns into values[column][row], for a row of the other file with this
  /// number and time.
  void give(std::int64_t number, double time_s, int row, const std::vector<double*>& values);
  /// After the last give(): rows that were never asked for.
  void read_rest();
  void rewind();
  /// What the file itself has to tell, and how well its rows fitted.
  Issues issues() const;

 private:
  /// One row of the file.
  struct Sample {
    double time_s = 0.0;
    std::vector<double> values;
  };

  bool next_row();
  void read_sample(Sample& sample);
  bool advance();
  void give_by_row(std::int64_t number, int row, const std::vector<double*>& values);
  void give_by_time(double time_s, int row, const std::vector<double*>& values);

  std::unique_ptr<RawReader> reader_;
  std::optional<RawTime> time_;
  RawBlock block_;
  int at_ = -1;  ///< row of the block
  bool ended_ = false;
  Sample before_, behind_;  ///< of the time that was asked for last
  bool has_before_ = false, has_behind_ = false;
  double step_s_ = 0.0;  ///< between the two rows before
  std::int64_t without_ = 0, between_ = 0, asked_ = 0, passed_ = 0;
};

}  // namespace faultline
