// SPDX-License-Identifier: MIT
#include "apps/python/column_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/core/error.hpp"
#include "lib/core/make_issue.hpp"

namespace faultline {
namespace {

std::int64_t rows_of(const std::vector<ColumnView>& columns, const std::string& name) {
  std::int64_t rows = -1;
  for (const ColumnView& column : columns) {
    if (column.is_text) continue;
    const std::int64_t length = std::ssize(column.values);
    if (rows < 0) rows = length;
    if (length != rows)
      throw Error(ErrorCode::input, name + ", column " + column.column.name,
                  fmt::format("has {} values, but the columns before it have {}; give columns of equal "
                              "length",
                              length, rows));
  }
  return std::max(rows, std::int64_t{0});
}

std::string_view bytes_of(std::span<const double> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

}  // namespace

ColumnReader::ColumnReader(std::vector<ColumnView> columns, std::string name)
    : columns_(std::move(columns)), wanted_(columns_.size(), true), rows_(rows_of(columns_, name)) {
  for (const ColumnView& column : columns_) names_.push_back(column.column);
  identity_.path = std::move(name);
  identity_.format = "arrays";
}

void ColumnReader::rewind() {
  identity_.rows_read = 0;
  issues_ = {};
}

bool ColumnReader::next(RawBlock& block, int max_rows) {
  const std::int64_t first = identity_.rows_read;
  if (first == 0) tell_text();
  if (first >= rows_) {
    if (identity_.sha256.empty()) identity_.sha256 = sha256_of(columns_);
    return false;
  }
  const std::int64_t rows = std::min<std::int64_t>(max_rows, rows_ - first);
  block.first_row = first;
  block.rows = static_cast<int>(rows);
  block.columns.resize(columns_.size());
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    std::vector<double>& to = block.columns[i];
    to.clear();
    if (!wanted_[i]) continue;
    if (columns_[i].is_text) {
      to.assign(static_cast<std::size_t>(rows), std::nan(""));
      continue;
    }
    const auto values =
        columns_[i].values.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(rows));
    to.assign(values.begin(), values.end());
  }
  identity_.rows_read += rows;
  return true;
}

double ColumnReader::share_read() const {
  return rows_ > 0 ? static_cast<double>(identity_.rows_read) / static_cast<double>(rows_) : 1.0;
}

void ColumnReader::tell_text() {
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (columns_[i].is_text && wanted_[i] && issues_.find("not_a_number", names_[i].name) == nullptr)
      issues_.add(make_issue("not_a_number", Severity::warning,
                             "the column holds no numbers; all its cells are missing", names_[i].name));
}

std::string sha256_of(const std::vector<ColumnView>& columns) {
  Sha256 hash;
  for (const ColumnView& column : columns) {
    hash.update(fmt::format("{}:{}{}:{}{}\n", column.column.name.size(), column.column.name,
                            column.column.unit.size(), column.column.unit, column.values.size()));
    hash.update(bytes_of(column.values));
  }
  return hash.hex();
}

}  // namespace faultline
