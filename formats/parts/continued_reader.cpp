// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "formats/parts/joined_reader.hpp"
#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "lib/log/units.hpp"

namespace faultline {
namespace {

class ContinuedReader : public RawReader {
 public:
  explicit ContinuedReader(std::vector<std::unique_ptr<RawReader>> files) : files_(std::move(files)) {
    for (const auto& file : files_) {
      places_.push_back(places_in(*file));
      factors_.push_back(factors_in(*file, places_.back()));
    }
    identity_ = files_.front()->identity();
    wanted_.assign(columns().size(), true);
  }

  const std::vector<RawColumn>& columns() const override { return files_.front()->columns(); }
  bool canonical() const override {
    return std::all_of(files_.begin(), files_.end(), [](const auto& file) { return file->canonical(); });
  }

  double share_read() const override {
    const double share = at_ < files_.size() ? files_[at_]->share_read() : 0.0;
    return (static_cast<double>(at_) + share) / static_cast<double>(files_.size());
  }

  void want(const std::vector<bool>& columns) override {
    wanted_ = columns;
    for (std::size_t f = 0; f < files_.size(); ++f) {
      std::vector<bool> theirs(files_[f]->columns().size(), false);
      for (std::size_t c = 0; c < columns.size(); ++c)
        if (places_[f][c] >= 0) theirs[places_[f][c]] = columns[c];
      files_[f]->want(theirs);
    }
  }

  void code_texts(int column) override {
    for (std::size_t f = 0; f < files_.size(); ++f)
      if (places_[f][column] >= 0) files_[f]->code_texts(places_[f][column]);
  }

  bool next(RawBlock& block, int max_rows) override {
    for (; at_ < files_.size(); ++at_) {
      const bool more = files_[at_]->next(theirs_, max_rows);
      identity_.rows_read = rows_before_ + files_[at_]->identity().rows_read;
      if (more) {
        take(block);
        return true;
      }
      rows_before_ = identity_.rows_read;
    }
    block.rows = 0;
    finish();
    return false;
  }

  void rewind() override {
    for (auto& file : files_) file->rewind();
    at_ = 0;
    rows_before_ = identity_.rows_read = 0;
  }

  const Issues& issues() const override {
    issues_ = {};
    for (std::size_t f = 0; f < files_.size(); ++f) {
      issues_.merge(files_[f]->issues());
      for (std::size_t c = 0; c < columns().size(); ++c)
        if (places_[f][c] < 0)
          issues_.add({"column_missing", columns()[c].name, Severity::warning,
                       fmt::format("{} has no column \"{}\"; its values are missing there",
                                   files_[f]->identity().path, columns()[c].name)});
    }
    return issues_;
  }

 private:
  std::vector<int> places_in(const RawReader& file) const {
    std::vector<int> places;
    for (const RawColumn& column : columns()) {
      const auto& theirs = file.columns();
      const auto found = std::find_if(theirs.begin(), theirs.end(),
                                      [&](const RawColumn& c) { return c.name == column.name; });
      places.push_back(found == theirs.end() ? -1 : static_cast<int>(found - theirs.begin()));
    }
    return places;
  }

  /// Returns the factors from the units of the file to those of the first file.
  std::vector<double> factors_in(const RawReader& file, const std::vector<int>& places) const {
    std::vector<double> factors(places.size(), 1.0);
    for (std::size_t c = 0; c < places.size(); ++c) {
      if (places[c] < 0) continue;
      const std::string &ours = columns()[c].unit, &theirs = file.columns()[places[c]].unit;
      if (ours == theirs) continue;
      const auto from = known_unit(theirs), to = known_unit(ours);
      if (!from || !to || from->dimension != to->dimension)
        throw Error(
            ErrorCode::input, file.identity().path,
            fmt::format("has column \"{}\" in \"{}\", but the first file of the log has it in \"{}\"; "
                        "write both in the same unit",
                        columns()[c].name, theirs, ours));
      factors[c] = from->factor / to->factor;
    }
    return factors;
  }

  void take(RawBlock& block) {
    block.first_row = rows_before_ + theirs_.first_row;
    block.rows = theirs_.rows;
    block.columns.resize(columns().size());
    for (std::size_t c = 0; c < columns().size(); ++c) {
      if (!wanted_[c]) continue;
      if (const int place = places_[at_][c]; place >= 0)
        block.columns[c].swap(theirs_.columns[place]);
      else
        block.columns[c].assign(block.rows, std::numeric_limits<double>::quiet_NaN());
      if (const double factor = factors_[at_][c]; factor != 1.0)
        for (double& value : block.columns[c]) value *= factor;
    }
  }

  void finish() {
    std::string hashes;
    for (const auto& file : files_) hashes += file->identity().sha256;
    identity_.sha256 = sha256_hex(hashes);
  }

  std::vector<std::unique_ptr<RawReader>> files_;
  std::vector<std::vector<int>> places_;      ///< by file and column: the file's column, -1 for none
  std::vector<std::vector<double>> factors_;  ///< by file and column, to the first file's units
  std::size_t at_ = 0;                        ///< file that is being read
  std::int64_t rows_before_ = 0;              ///< of the files before it
  RawBlock theirs_;
  mutable Issues issues_;
};

}  // namespace

std::unique_ptr<RawReader> continue_files(std::vector<std::unique_ptr<RawReader>> files) {
  return std::make_unique<ContinuedReader>(std::move(files));
}

}  // namespace faultline
