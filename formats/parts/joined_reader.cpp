// SPDX-License-Identifier: MIT
#include "formats/parts/joined_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "lib/core/issue.hpp"
#include "lib/log/column_families.hpp"
#include "lib/log/raw_reader.hpp"
#include "lib/log/units.hpp"

namespace faultline {
namespace {

constexpr int kPartnerRowsAtOnce = 4096;
/// Largest distance of rows, as a multiple of the usual step, across which values are interpolated.
constexpr double kWidestGap = 5.0;

/// The time columns of a file.
struct RawTime {
  int column = -1;
  int nanoseconds = -1;  ///< second column of a time in seconds and nanoseconds; -1 for none
  double factor = 1.0;   ///< to s

  double at(const RawBlock& block, int row) const {
    const double seconds = factor * block.columns[column][row];
    return nanoseconds < 0 ? seconds : seconds + 1e-9 * block.columns[nanoseconds][row];
  }
};

/// Returns the time column that the file declares, else one with a suitable name; nullopt for none.
std::optional<RawTime> find_raw_time(const std::vector<RawColumn>& columns) {
  std::vector<std::string> names;
  for (int i = 0; i < std::ssize(columns); ++i) {
    if (columns[i].meaning == Channel{}) return RawTime{i, -1, si_factor(columns[i].unit).value_or(1.0)};
    names.push_back(columns[i].name);
  }
  if (const int column = find_time_column(names); column >= 0)
    return RawTime{column, -1, si_factor(columns[column].unit).value_or(1.0)};
  if (const auto pair = find_time_pair(names)) return RawTime{pair->seconds, pair->nanoseconds, 1.0};
  return std::nullopt;
}

/// A file that is joined to another: supplies values for the rows of that file, which must be requested in
/// order.
class Partner {
 public:
  /// Joins by time if `time` is given, else by row.
  Partner(std::unique_ptr<RawReader> reader, std::optional<RawTime> time)
      : reader_(std::move(reader)), time_(time) {}

  const RawReader& reader() const { return *reader_; }
  /// Writes the values of the file's columns into values[column][row], for a row of the other file with this
  /// number and time.
  void give(std::int64_t number, double time_s, int row, const std::vector<double*>& values) {
    ++asked_;
    if (time_)
      give_by_time(time_s, row, values);
    else
      give_by_row(number, row, values);
  }

  /// After the last give(), reads the rest of the file for its hash; of a join by row, counts the rows that
  /// were never requested.
  void read_rest() {
    while (!time_ && next_row()) ++passed_;
    while (reader_->next(block_, kPartnerRowsAtOnce)) {
    }
  }

  void rewind() {
    reader_->rewind();
    block_ = {};
    at_ = -1;
    ended_ = has_before_ = has_behind_ = false;
    step_s_ = 0.0;
    without_ = between_ = asked_ = passed_ = 0;
  }

  /// Returns the issues of the file and of the match of its rows.
  Issues issues() const {
    Issues issues = reader_->issues();
    const std::string& path = reader_->identity().path;
    if (without_ > 0)
      issues.add({"join_without_partner", "", Severity::warning,
                  fmt::format("{} of {} rows have no matching row in {}; its values are missing there",
                              without_, asked_, path)});
    if (passed_ > 0)
      issues.add(
          {"join_rows_left", "", Severity::warning,
           fmt::format("{} rows of {} match no row of the log: {}", passed_, path,
                       time_ ? "their time goes backward or is missing" : "they follow its last row")});
    if (between_ > 0)
      issues.add(
          {"join_interpolated", "", Severity::note,
           fmt::format("{} of {} rows lie between two rows of {}; its values were interpolated linearly",
                       between_, asked_, path)});
    return issues;
  }

 private:
  /// One row of the file.
  struct Sample {
    double time_s = 0.0;
    std::vector<double> values;
  };

  bool next_row() {
    if (++at_ < block_.rows) return true;
    at_ = 0;
    if (!ended_) ended_ = !reader_->next(block_, kPartnerRowsAtOnce);
    if (ended_) block_.rows = 0;
    return !ended_;
  }

  void read_sample(Sample& sample) {
    sample.time_s = time_->at(block_, at_);
    sample.values.resize(block_.columns.size());
    for (std::size_t c = 0; c < block_.columns.size(); ++c) sample.values[c] = block_.columns[c][at_];
  }

  /// Moves to the next row with a later time than the last one; other rows cannot be found by time.
  bool advance() {
    if (has_behind_) {
      if (has_before_) step_s_ = behind_.time_s - before_.time_s;
      std::swap(before_, behind_);
      has_before_ = true;
    }
    has_behind_ = false;
    while (!has_behind_ && next_row()) {
      read_sample(behind_);
      has_behind_ = std::isfinite(behind_.time_s) && (!has_before_ || behind_.time_s > before_.time_s);
      passed_ += !has_behind_;
    }
    return has_behind_;
  }

  void give_by_row(std::int64_t number, int row, const std::vector<double*>& values) {
    while (!ended_ && (block_.rows == 0 || block_.first_row + at_ < number)) next_row();
    const bool there = !ended_ && block_.first_row + at_ == number;
    without_ += !there;
    for (std::size_t c = 0; c < values.size(); ++c)
      if (values[c]) values[c][row] = there ? block_.columns[c][at_] : kNan;
  }

  void give_by_time(double time_s, int row, const std::vector<double*>& values) {
    while ((!has_behind_ || behind_.time_s < time_s) && advance()) {
    }
    const bool exact = has_behind_ && behind_.time_s == time_s;
    const double gap_s = has_before_ && has_behind_ ? behind_.time_s - before_.time_s : 0.0;
    const bool near =
        gap_s > 0.0 && (step_s_ <= 0.0 || gap_s <= kWidestGap * step_s_) && before_.time_s < time_s;
    without_ += !exact && !near;
    between_ += !exact && near;
    for (std::size_t c = 0; c < values.size(); ++c) {
      if (!values[c]) continue;
      values[c][row] = exact ? behind_.values[c] : kNan;
      if (exact || !near) continue;
      const double share = (time_s - before_.time_s) / gap_s;
      values[c][row] = before_.values[c] + share * (behind_.values[c] - before_.values[c]);
    }
  }

  std::unique_ptr<RawReader> reader_;
  std::optional<RawTime> time_;
  RawBlock block_;
  int at_ = -1;  ///< row of the block
  bool ended_ = false;
  Sample before_, behind_;  ///< around the last requested time
  bool has_before_ = false, has_behind_ = false;
  double step_s_ = 0.0;  ///< from the row before before_ to before_
  std::int64_t without_ = 0, between_ = 0, asked_ = 0, passed_ = 0;
};

class JoinedReader : public RawReader {
 public:
  JoinedReader(std::unique_ptr<RawReader> first, std::vector<std::unique_ptr<RawReader>> others, JoinBy by)
      : first_(std::move(first)), columns_(first_->columns()) {
    const auto time = find_raw_time(columns_);
    for (auto& other : others) add(std::move(other), time, by);
    want(std::vector<bool>(columns_.size(), true));
    identity_ = first_->identity();
  }

  const std::vector<RawColumn>& columns() const override { return columns_; }
  double share_read() const override { return first_->share_read(); }

  void want(const std::vector<bool>& columns) override {
    wanted_ = columns;
    std::vector<bool> of_first(columns.begin(), columns.begin() + std::ssize(first_->columns()));
    if (time_) {
      of_first[time_->column] = true;
      if (time_->nanoseconds >= 0) of_first[time_->nanoseconds] = true;
    }
    first_->want(of_first);
  }

  /// Texts of the joined files stay missing: their rows are matched as numbers.
  void code_texts(int column) override {
    if (column < std::ssize(first_->columns())) first_->code_texts(column);
  }

  bool next(RawBlock& block, int max_rows) override {
    const bool more = first_->next(block, max_rows);
    block.columns.resize(columns_.size());
    for (Joined& joined : joined_) fill(joined, block);
    identity_.rows_read = first_->identity().rows_read;
    if (!more) finish();
    return more;
  }

  void rewind() override {
    first_->rewind();
    for (Joined& joined : joined_) joined.partner.rewind();
    identity_.rows_read = 0;
  }

  const Issues& issues() const override {
    issues_ = first_->issues();
    for (const Joined& joined : joined_) {
      const Issues theirs = joined.partner.issues();
      for (const Issue& issue : theirs.all()) issues_.add(without_drops(issue));
    }
    return issues_;
  }

 private:
  struct Joined {
    Partner partner;
    std::vector<int> places;  ///< by column of the partner: its column here, -1 for none
  };

  void add(std::unique_ptr<RawReader> other, const std::optional<RawTime>& time, JoinBy by) {
    const auto its_time = find_raw_time(other->columns());
    const bool by_time = by == JoinBy::time || (by == JoinBy::automatic && time && its_time);
    const std::string& path = other->identity().path;
    if (by_time && !(time && its_time))
      throw Error(ErrorCode::input, time ? path : first_->identity().path,
                  "has no column that looks like a time, so it cannot be joined by time; join by row");
    if (by_time) time_ = time;
    std::vector<int> places;
    for (int c = 0; c < std::ssize(other->columns()); ++c) {
      const bool is_time = by_time && (c == its_time->column || c == its_time->nanoseconds);
      places.push_back(is_time ? -1 : static_cast<int>(columns_.size()));
      if (!is_time) columns_.push_back(named_apart(other->columns()[c], path));
    }
    joined_.push_back({Partner(std::move(other), by_time ? its_time : std::nullopt), places});
  }

  RawColumn named_apart(RawColumn column, const std::string& path) const {
    std::set<std::string> taken;
    for (const RawColumn& mine : columns_) taken.insert(mine.name);
    const std::string file = std::filesystem::path(path).filename().string();
    while (taken.count(column.name)) column.name = file + "/" + column.name;
    return column;
  }

  void fill(Joined& joined, RawBlock& block) {
    std::vector<double*> values;
    for (const int place : joined.places) {
      const bool wanted = place >= 0 && wanted_[place];
      if (wanted) block.columns[place].resize(block.rows);
      values.push_back(wanted ? block.columns[place].data() : nullptr);
    }
    for (int row = 0; row < block.rows; ++row)
      joined.partner.give(block.first_row + row, time_ ? time_->at(block, row) : 0.0, row, values);
  }

  /// Converts dropped rows of a partner, which are only missing values here.
  static Issue without_drops(Issue issue) {
    issue.rows_dropped = 0;
    return issue;
  }

  /// Sets the hash: that of the file if all parts are of one, else one of the hashes of all files.
  void finish() {
    const LogIdentity& first = first_->identity();
    std::string hashes = first.sha256;
    bool is_one_file = true;
    for (Joined& joined : joined_) {
      joined.partner.read_rest();
      const LogIdentity& other = joined.partner.reader().identity();
      is_one_file = is_one_file && other.path == first.path;
      hashes += other.sha256;
    }
    identity_.sha256 = is_one_file ? first.sha256 : sha256_hex(hashes);
  }

  std::unique_ptr<RawReader> first_;
  std::vector<RawColumn> columns_;
  std::optional<RawTime> time_;  ///< of the first file, if some file is joined by time
  std::vector<Joined> joined_;
  mutable Issues issues_;
};

}  // namespace

std::unique_ptr<RawReader> join_files(std::unique_ptr<RawReader> first,
                                      std::vector<std::unique_ptr<RawReader>> others, JoinBy by) {
  return std::make_unique<JoinedReader>(std::move(first), std::move(others), by);
}

}  // namespace faultline
