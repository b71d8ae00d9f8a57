// SPDX-License-Identifier: MIT
#include "formats/parts/joined_reader.hpp"

#include <filesystem>
#include <set>
#include <utility>

#include "formats/parts/partner.hpp"
#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"

namespace faultline {
namespace {

/// One hash for several files, once all are known.
std::string hash_of_hashes(const std::vector<std::string>& hashes) {
  Sha256 all;
  for (const std::string& hash : hashes) {
    if (hash.empty()) return "";
    all.update(hash);
  }
  return all.hex();
}

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
  bool canonical() const override { return false; }
  const LogIdentity& identity() const override { return identity_; }
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

  /// Rows that a partner lost are values that are missing here.
  static Issue without_drops(Issue issue) {
    issue.rows_dropped = 0;
    return issue;
  }

  void finish() {
    std::vector<std::string> hashes{first_->identity().sha256};
    RawBlock rest;
    for (Joined& joined : joined_) {
      joined.partner.read_rest();
      while (joined.partner.reader().next(rest, 4096)) {
      }
      hashes.push_back(joined.partner.reader().identity().sha256);
    }
    identity_.sha256 = hash_of_hashes(hashes);
  }

  std::unique_ptr<RawReader> first_;
  std::vector<RawColumn> columns_;
  std::optional<RawTime> time_;  ///< of the first file, where some file is joined by it
  std::vector<Joined> joined_;
  std::vector<bool> wanted_;
  LogIdentity identity_;
  mutable Issues issues_;
};

}  // namespace

std::unique_ptr<RawReader> join_files(std::unique_ptr<RawReader> first,
                                      std::vector<std::unique_ptr<RawReader>> others, JoinBy by) {
  return std::make_unique<JoinedReader>(std::move(first), std::move(others), by);
}

}  // namespace faultline
