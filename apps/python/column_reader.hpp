// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lib/core/hash.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// A column of numbers in memory that the caller owns.
struct ColumnView {
  RawColumn column;
  std::span<const double> values;
  bool is_text = false;  ///< a column without numbers; `values` is empty and each cell is missing
};

/// A log of columns in memory, read without a copy of the whole: only one block at a time is copied.
class ColumnReader : public RawReader {
 public:
  /// The values must outlive the reader and not change. Throws Error(input) for columns of unequal length.
  ColumnReader(std::vector<ColumnView> columns, std::string name);

  const std::vector<RawColumn>& columns() const override { return names_; }
  void want(const std::vector<bool>& columns) override { wanted_ = columns; }
  bool next(RawBlock& block, int max_rows) override;
  void rewind() override;
  const LogIdentity& identity() const override { return identity_; }
  const Issues& issues() const override { return issues_; }
  double share_read() const override;

 private:
  void tell_text();

  std::vector<ColumnView> columns_;
  std::vector<RawColumn> names_;
  std::vector<bool> wanted_;
  LogIdentity identity_;
  Issues issues_;
  std::int64_t rows_ = 0;
};

/// Hashes names, units and values of the columns in order (SHA-256): the identity of a log without a file.
std::string sha256_of(const std::vector<ColumnView>& columns);

}  // namespace faultline
