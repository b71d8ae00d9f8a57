// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "formats/arrays/array_file.hpp"
#include "formats/arrays/array_table.hpp"
#include "formats/byte_source.hpp"
#include "formats/provenance.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {
namespace {

/// Values of a slab (rows that are read at once): 4 MiB for any number of columns, so that caches hold it.
constexpr std::int64_t kSlabValues = 1 << 19;
constexpr std::int64_t kMostSlabRows = 1 << 16;

class ArrayReader : public RawReader {
 public:
  ArrayReader(std::unique_ptr<ByteSource> bytes, const std::string& format, OpenArrays open)
      : bytes_(std::move(bytes)), open_(open) {
    identity_.path = bytes_->path();
    identity_.format = format;
    std::error_code error;
    if (!std::filesystem::is_regular_file(identity_.path, error))
      throw Error(ErrorCode::input, identity_.path,
                  "is a pipe or a device, but array formats need random access; copy it to a file");
    const auto file = open_(identity_.path);
    arrays_ = named(*file);
    refuse_damaged(*file);
    table_ = table_of(arrays_, identity_.path);
    if (table_.rows_held == 0) throw Error(ErrorCode::input, identity_.path, why_no_table(arrays_));
    WorkBudget(identity_.path)
        .spend(table_work_ns(table_.rows_held, std::ssize(table_.columns)), bytes_->file_size());
    file->will_read(bands_of(table_));
    for (NamedArray& array : arrays_) array.rows_held = array.columns_held = nullptr;  // they need the file
    wanted_.assign(table_.columns.size(), true);
    gather_opening_issues(*file);
    start();
  }

  const std::vector<RawColumn>& columns() const override { return table_.columns; }
  const Issues& issues() const override { return issues_; }
  double share_read() const override {
    return table_.rows_held > 0 ? static_cast<double>(given_) / static_cast<double>(table_.rows_held) : 1.0;
  }

  bool next(RawBlock& block, int max_rows) override {
    block.rows = 0;
    block.columns.resize(table_.columns.size());
    for (std::vector<double>& column : block.columns) column.clear();
    while (block.rows < max_rows) {
      if (given_ == slab_first_ + slab_rows_ && !next_slab()) break;
      const std::int64_t sound = pass_lost();
      if (sound == 0) continue;
      if (block.rows == 0) block.first_row = given_;
      if (given_ != block.first_row + block.rows) break;  // rows of a block are consecutive
      give(block, std::min<std::int64_t>(max_rows - block.rows, sound));
    }
    identity_.rows_read = given_ + rows_cut_;
    return block.rows > 0;
  }

  void rewind() override {
    bytes_->rewind();
    start();
  }

 private:
  /// Throws Error(input) if no array could be read; the reason is the first issue.
  void refuse_damaged(const ArrayFile& file) const {
    if (arrays_.empty() && !file.issues().empty())
      throw Error(ErrorCode::input, identity_.path,
                  "holds no readable array: " + file.issues().all().front().message);
  }

  /// Returns the arrays of the file with the channel names of the log that was written to it.
  std::vector<NamedArray> named(const ArrayFile& file) {
    std::vector<NamedArray> arrays = file.arrays();
    if (file.notes().empty()) return arrays;
    const auto notes = read_notes(file.notes());
    if (!notes || !notes->provenance.empty())
      opening_.add(issue_from_provenance(notes ? notes->provenance : ""));
    if (!notes) return arrays;
    int rank = 0;
    for (const NotedChannel& channel : notes->extra) {
      ++rank;
      for (NamedArray& array : arrays)
        if (array.name == channel.array) {
          array.rank = rank;
          array.names = {channel.name};
          array.units = {channel.unit};
          array.exact = true;
        }
    }
    return arrays;
  }

  void gather_opening_issues(const ArrayFile& file) {
    opening_.merge(file.issues());
    opening_.merge(table_.issues);
    for (const TableArray& used : table_.arrays) {
      const std::int64_t lost = table_.rows_held - used.rows_held;
      if (lost > 0)
        for (std::size_t c = 0; c < used.columns; ++c)
          report_column(opening_, "file_truncated", used.first_column + c, used.rows_held, lost,
                        "the file ends before them");
    }
  }

  void start() {
    issues_ = opening_;
    file_.reset();
    slab_first_ = slab_rows_ = given_ = rows_cut_ = 0;
    at_end_ = false;
    identity_.rows_read = 0;
  }

  void open_again() {
    file_ = open_(identity_.path);
    const auto& arrays = file_->arrays();
    const auto same = [](const NamedArray& a, const NamedArray& b) {
      return a.name == b.name && a.shape == b.shape;
    };
    if (!std::equal(arrays.begin(), arrays.end(), arrays_.begin(), arrays_.end(), same))
      throw Error(ErrorCode::input, identity_.path,
                  "was replaced or changed while it was read; run again when it is complete");
    file_->will_read(bands_of(table_));
  }

  bool next_slab() {
    if (at_end_) return false;
    if (!file_) open_again();
    const auto columns = static_cast<std::int64_t>(table_.columns.size());
    slab_first_ = given_;
    slab_rows_ = std::min(table_.rows_held - given_,
                          std::clamp<std::int64_t>(kSlabValues / columns, 1, kMostSlabRows));
    if (slab_rows_ == 0) {
      finish();
      return false;
    }
    slab_.resize(table_.columns.size());
    dropped_.assign(static_cast<std::size_t>(slab_rows_), 0);
    values_lost_.assign(static_cast<std::size_t>(slab_rows_), 0);
    for (const TableArray& used : table_.arrays) read_array(used);
    const auto wanted = std::count(wanted_.begin(), wanted_.end(), true);
    for (std::size_t row = 0; row < dropped_.size(); ++row)
      if (values_lost_[row] >= wanted) dropped_[row] = 1;
    return true;
  }

  void read_array(const TableArray& used) {
    ArrayBand band{used.array, used.channel_major, slab_first_, 0, {}};
    for (std::size_t c = 0; c < used.columns; ++c)
      if (wanted_[used.first_column + c]) band.columns.push_back(static_cast<std::int64_t>(c));
    if (band.columns.empty()) return;
    band.rows = std::clamp<std::int64_t>(used.rows_held - slab_first_, 0, slab_rows_);
    swap_columns(used, band);
    for (std::vector<double>& column : values_.columns) column.resize(static_cast<std::size_t>(slab_rows_));
    values_.lost.clear();
    if (band.rows > 0) file_->read(band, values_);
    swap_columns(used, band);
    for (const LostRows& lost : values_.lost) take_loss(used, band, lost, true);
    if (band.rows < slab_rows_) take_loss(used, band, {band.rows, slab_rows_ - band.rows}, false);
  }

  void swap_columns(const TableArray& used, const ArrayBand& band) {
    values_.columns.resize(band.columns.size());
    for (std::size_t i = 0; i < band.columns.size(); ++i)
      values_.columns[i].swap(slab_[used.first_column + static_cast<std::size_t>(band.columns[i])]);
  }

  /// Sets lost values to NaN and marks rows without their time as dropped.
  void take_loss(const TableArray& used, const ArrayBand& band, const LostRows& lost, bool damaged) {
    for (std::size_t i = 0; i < band.columns.size(); ++i) {
      if (lost.column >= 0 && static_cast<int>(i) != lost.column) continue;
      const std::size_t column = used.first_column + static_cast<std::size_t>(band.columns[i]);
      if (damaged)
        report_column(issues_, "array_damaged", column, slab_first_ + lost.first, lost.rows,
                      "they are damaged in the file");
      for (auto row = static_cast<std::size_t>(lost.first);
           row < static_cast<std::size_t>(lost.first + lost.rows); ++row) {
        slab_[column][row] = kNan;
        ++values_lost_[row];
        if (static_cast<int>(column) == table_.time_column) dropped_[row] = 1;
      }
    }
  }

  void report_column(Issues& issues, const char* code, std::size_t column, std::int64_t row,
                     std::int64_t count, const std::string& why) const {
    const std::string& name = table_.columns[column].name;
    issues.add({code, name, Severity::severe,
                fmt::format("values of \"{}\" could not be read from row {} on and count as missing: {}",
                            shortened(name, kLongestName), row + 1, why),
                row + 1, kNan, count});
  }

  /// Skips dropped rows; returns the number of valid rows that follow in the slab.
  std::int64_t pass_lost() {
    auto at = dropped_.begin() + (given_ - slab_first_);
    const auto sound = std::find(at, dropped_.end(), 0);
    const std::int64_t lost = sound - at;
    if (lost > 0)
      drop("rows_damaged", lost, "rows whose time, or all of whose values, could not be read were left out");
    given_ += lost;
    return std::find(sound, dropped_.end(), 1) - sound;
  }

  void drop(const char* code, std::int64_t rows, const std::string& what) {
    issues_.add({code, "", Severity::severe, fmt::format("from row {} on: {}", given_ + 1, what), given_ + 1,
                 kNan, 1, rows});
  }

  void give(RawBlock& block, std::int64_t rows) {
    const std::int64_t at = given_ - slab_first_;
    for (std::size_t c = 0; c < slab_.size(); ++c)
      if (wanted_[c])
        block.columns[c].insert(block.columns[c].end(), slab_[c].begin() + at, slab_[c].begin() + at + rows);
    given_ += rows;
    block.rows += static_cast<int>(rows);
  }

  /// Reports the rows that the file cannot hold, and reads all bytes for the hash.
  void finish() {
    at_end_ = true;
    rows_cut_ = table_.rows - table_.rows_held;
    if (rows_cut_ > 0)
      drop("file_truncated", rows_cut_,
           fmt::format("the file ends before the {} rows that it declares; {} were left out", table_.rows,
                       rows_cut_));
    file_->finish();
    for (const Issue& issue : file_->issues().all())
      if (!opening_.find(issue.code, issue.channel)) issues_.add(issue);
    file_.reset();
    slab_ = {};
    ByteWindow(*bytes_).drain();
    identity_.sha256 = bytes_->sha256();
  }

  std::unique_ptr<ByteSource> bytes_;
  OpenArrays open_;
  std::unique_ptr<ArrayFile> file_;  ///< null unless rows are being read
  std::vector<NamedArray> arrays_;
  ArrayTable table_;
  std::vector<std::vector<double>> slab_;  ///< by column of the table; empty if not wanted
  std::vector<char> dropped_;              ///< by row of the slab
  std::vector<std::int64_t> values_lost_;  ///< by row of the slab
  BandValues values_;
  std::int64_t slab_first_ = 0, slab_rows_ = 0;
  std::int64_t given_ = 0;     ///< rows handed out or dropped so far
  std::int64_t rows_cut_ = 0;  ///< after the last that the file can hold, already reported
  bool at_end_ = false;
  Issues opening_;  ///< issues found on opening
  Issues issues_;
};

}  // namespace

std::unique_ptr<RawReader> read_arrays(std::unique_ptr<ByteSource> bytes, const std::string& format,
                                       OpenArrays open) {
  return std::make_unique<ArrayReader>(std::move(bytes), format, open);
}

}  // namespace faultline
