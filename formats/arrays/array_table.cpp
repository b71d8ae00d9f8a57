// SPDX-License-Identifier: MIT
#include "formats/arrays/array_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "lib/core/error.hpp"
#include "lib/core/issue.hpp"
#include "lib/core/text.hpp"
#include "lib/log/channel_names.hpp"
#include "lib/log/units.hpp"

namespace faultline {
namespace {

constexpr std::size_t kMostTold = 8;  ///< arrays that a message lists by name

/// Upper limit of the columns of a table; no log has more.
constexpr std::int64_t kMostArrayColumns = 1 << 14;
constexpr double kMostOfARobot = 64.0;  ///< longest list of robot data, such as limits of its joints

using Shape = std::vector<std::int64_t>;

/// Returns the shape without dimensions of one, except that a vector of one element stays a vector.
Shape squeezed(const Shape& shape) {
  Shape kept;
  for (const std::int64_t size : shape)
    if (size != 1) kept.push_back(size);
  if (kept.empty() && !shape.empty()) kept.push_back(1);
  return kept;
}

double elements(const Shape& shape) {
  double count = 1.0;
  for (const std::int64_t size : shape) count *= static_cast<double>(size);
  return count;
}

/// Returns the name and shape, such as "q" (100 x 3), for messages.
std::string array_label(const NamedArray& array) {
  const std::string name =
      array.name.empty() ? "the array" : "\"" + shortened(array.name, kLongestName) + "\"";
  return name + " (" + fmt::format("{}", fmt::join(array.shape, " x ")) + ")";
}

/// Returns the labels of the first arrays and the number of further ones.
std::string listed_arrays(const std::vector<const NamedArray*>& arrays) {
  std::string names;
  for (std::size_t i = 0; i < std::min(kMostTold, arrays.size()); ++i)
    names += (i > 0 ? ", " : "") + array_label(*arrays[i]);
  if (arrays.size() > kMostTold) names += fmt::format(" and {} more", arrays.size() - kMostTold);
  return names;
}

std::string leaf_of(const std::string& name) {
  const auto at = name.find_last_of("/.");
  return at == std::string::npos || at + 1 == name.size() ? name : name.substr(at + 1);
}

/// True when a vector of three or more dimensions becomes 1 x N after trailing dimensions of one are removed.
bool after_ones(const Shape& shape) { return shape.size() > 2 && shape.back() != 1; }

/// Returns, for each length, the number of elements of the arrays that have a dimension of that length.
std::map<std::int64_t, double> votes_of(const std::vector<NamedArray>& arrays) {
  std::map<std::int64_t, double> votes;
  for (const NamedArray& array : arrays) {
    const Shape shape = squeezed(array.shape);
    for (const std::int64_t size : std::set<std::int64_t>(shape.begin(), shape.end()))
      votes[size] += elements(shape);
  }
  return votes;
}

bool looks_like_time(const NamedArray& array) {
  const std::string leaf = split_unit(leaf_of(array.name)).name;
  return squeezed(array.shape).size() == 1 && find_time_column({leaf}) >= 0;
}

/// True when the name is that of a signal, or the array is a list longer than a robot has of one kind; an
/// image is excluded because it is that long in both dimensions.
bool looks_recorded(const NamedArray& array) {
  if (looks_like_time(array) || parse_name(split_unit(leaf_of(array.name)).name).quantity) return true;
  const Shape shape = squeezed(array.shape);
  const double longest =
      shape.empty() ? 0.0 : static_cast<double>(*std::max_element(shape.begin(), shape.end()));
  return longest > kMostOfARobot && elements(shape) <= kMostOfARobot * longest;
}

/// Returns the length with the most votes, the largest of equals.
std::int64_t preferred(const std::map<std::int64_t, double>& votes) {
  std::int64_t best = 0;
  double most = -1.0;
  for (const auto& [length, count] : votes)
    if (count >= most) best = length, most = count;
  return best;
}

/// True when most elements are stored as one row; else a single time is a sample period.
bool is_one_row(const std::vector<NamedArray>& arrays) {
  double all = 0.0, in_one_row = 0.0;
  for (const NamedArray& array : arrays) {
    all += elements(array.shape);
    if (!array.shape.empty() && array.shape[0] == 1) in_one_row += elements(array.shape);
  }
  return in_one_row > 0.5 * all;
}

std::int64_t rows_of(const std::vector<NamedArray>& arrays) {
  const std::map<std::int64_t, double> votes = votes_of(arrays);
  std::map<std::int64_t, double> of_times;
  for (const NamedArray& array : arrays) {
    if (!looks_like_time(array)) continue;
    const std::int64_t length = squeezed(array.shape).front();
    const bool one = length == 1 && (array.shape.size() > 1 || !is_one_row(arrays));
    if (!one) of_times[length] = votes.at(length);
  }
  return preferred(of_times.empty() ? votes : of_times);
}

class TableMaker {
 public:
  TableMaker(const std::vector<NamedArray>& arrays, const std::string& path) : arrays_(arrays), path_(path) {}

  ArrayTable run() {
    const bool any = std::any_of(arrays_.begin(), arrays_.end(),
                                 [](const NamedArray& array) { return !squeezed(array.shape).empty(); });
    if (!any)
      throw Error(ErrorCode::input, path_,
                  "holds no array of numbers; a log needs at least an array of times and one of positions");
    table_.rows = rows_of(arrays_);
    std::vector<std::size_t> order(arrays_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return arrays_[a].rank < arrays_[b].rank; });
    for (const std::size_t i : order) consider(i);
    name_columns();
    report_left_out();
    find_time();
    return std::move(table_);
  }

 private:
  /// True when the second dimension of the array has the rows; nullopt when none has.
  std::optional<bool> is_channel_major(const NamedArray& array) const {
    const Shape shape = squeezed(array.shape);
    if (shape.empty() || shape.size() > 2) return std::nullopt;
    if (shape.size() == 1 && shape[0] == table_.rows) {
      return array.shape.size() == 2 ? array.shape[0] != table_.rows : after_ones(array.shape);
    }
    if (shape.size() == 1)  // one row
      return table_.rows == 1 && array.shape.size() == 2 ? std::optional(array.shape[0] != 1) : std::nullopt;
    if (shape[0] == table_.rows) return false;
    return shape[1] == table_.rows ? std::optional(true) : std::nullopt;
  }

  static std::int64_t width_of(const NamedArray& array, std::int64_t rows) {
    const Shape shape = squeezed(array.shape);
    if (shape.size() == 1) return shape[0] == rows ? 1 : shape[0];
    return shape[0] == rows ? shape[1] : shape[0];
  }

  void consider(std::size_t index) {
    const NamedArray& array = arrays_[index];
    const auto channel_major = is_channel_major(array);
    if (!channel_major || (*channel_major && array.records)) {
      if (elements(array.shape) != 1.0) left_out_.push_back(&array);
      return;
    }
    const std::int64_t width = width_of(array, table_.rows);
    const std::int64_t held =
        array.columns_held ? std::min(width, array.columns_held(*channel_major)) : width;
    if (width > kMostArrayColumns - static_cast<std::int64_t>(total_)) return left_out_.push_back(&array);
    const Shape shape = squeezed(array.shape);
    if (shape.size() == 2 && shape[0] == shape[1] && table_.rows > 1)
      table_.issues.add(make_issue(
          "array_square", Severity::note,
          array_label(array) + " has as many rows as columns; its rows were taken as samples", array.name));
    if (held < width)
      table_.issues.add(make_issue("file_truncated", Severity::severe,
                                   fmt::format("the file ends inside {}; {} of its {} columns were left out",
                                               array_label(array), width - held, width),
                                   array.name));
    if (held <= 0) return;
    const std::int64_t rows = array.rows_held ? array.rows_held(*channel_major) : table_.rows;
    table_.arrays.push_back({index, *channel_major, std::clamp<std::int64_t>(rows, 0, table_.rows), total_,
                             static_cast<std::size_t>(held)});
    table_.rows_held = std::max(table_.rows_held, table_.arrays.back().rows_held);
    total_ += static_cast<std::size_t>(held);
  }

  /// Names the columns by the last part of the array's name if it is unique in the table, else by all of it.
  void name_columns() {
    std::map<std::string, int> leaves;
    for (const TableArray& used : table_.arrays) ++leaves[leaf_of(arrays_[used.array].name)];
    for (const TableArray& used : table_.arrays) {
      const NamedArray& array = arrays_[used.array];
      const std::string leaf = leaf_of(array.name);
      add_columns(array, used.columns, width_of(array, table_.rows), leaves[leaf] == 1 ? leaf : array.name);
    }
  }

  void add_columns(const NamedArray& array, std::size_t columns, std::int64_t width,
                   const std::string& name) {
    const NameAndUnit parts = split_unit(valid_utf8(name));
    const std::string stem = parts.name.empty() ? "column" : parts.name;
    const bool digit = std::isdigit(static_cast<unsigned char>(stem.back())) != 0;
    const bool plain = width == 1 && !array.name.empty();
    const bool named = static_cast<std::int64_t>(array.names.size()) == width;
    for (std::size_t c = 0; c < columns; ++c) {
      RawColumn column{plain ? stem : stem + (digit ? "_" : "") + std::to_string(c + 1),
                       array.unit.empty() ? parts.unit : array.unit};
      if (c < array.units.size() && (array.exact || !array.units[c].empty())) column.unit = array.units[c];
      if (named && !array.names[c].empty()) take_name(array, c, column);
      column.name = unique(valid_utf8(column.name), array.name);
      column.unit = valid_utf8(column.unit);
      table_.columns.push_back(column);
    }
  }

  static void take_name(const NamedArray& array, std::size_t c, RawColumn& column) {
    const NameAndUnit parts = array.exact ? NameAndUnit{array.names[c], ""} : split_unit(array.names[c]);
    column.name = parts.name;
    if (column.unit.empty() && !array.exact) column.unit = parts.unit;
  }

  /// Returns the name, changed if another array has a column of that name.
  std::string unique(const std::string& name, const std::string& array) {
    std::string tried = name;
    if (!taken_.insert(tried).second) tried = valid_utf8(array) + "/" + name;
    for (int i = 2; tried != name && !taken_.insert(tried).second; ++i)
      tried = name + "#" + std::to_string(i);
    return tried;
  }

  void report_left_out() {
    const auto lost = std::stable_partition(left_out_.begin(), left_out_.end(),
                                            [](const NamedArray* array) { return !looks_recorded(*array); });
    report_left_out("array_left_out", Severity::note, {left_out_.begin(), lost}, "");
    report_left_out("signal_left_out", Severity::warning, {lost, left_out_.end()},
                    "; write signals of another length into a separate file and --join it by time");
  }

  void report_left_out(const char* code, Severity severity, const std::vector<const NamedArray*>& arrays,
                       const char* advice) {
    if (arrays.empty()) return;
    const bool one = arrays.size() == 1;
    table_.issues.add(
        make_issue(code, severity,
                   fmt::format("{} {} not fit a table of {} rows and {} left out{}", listed_arrays(arrays),
                               one ? "does" : "do", table_.rows, one ? "was" : "were", advice)));
  }

  void find_time() {
    std::vector<std::string> names;
    for (const RawColumn& column : table_.columns) names.push_back(column.name);
    table_.time_column = find_time_column(names);
    note_other_clocks();
  }

  /// Reports arrays of times other than the one used: their signals are matched row by row nevertheless.
  void note_other_clocks() {
    std::string clocks;
    int found = 0;
    for (const NamedArray& array : arrays_) {
      const std::string leaf = leaf_of(array.name);
      const bool clock = looks_like_time(array) || ((leaf.starts_with("t_") || leaf.starts_with("time_")) &&
                                                    squeezed(array.shape).size() == 1);
      if (!clock) continue;
      clocks += (found++ > 0 ? ", " : "") + array_label(array);
    }
    if (found > 1)
      table_.issues.add(
          make_issue("several_clocks", Severity::warning,
                     clocks + " look like times; the log uses one of them for all rows. If other signals "
                              "were sampled at other times, write these into separate files and --join "
                              "them by time"));
  }

  const std::vector<NamedArray>& arrays_;
  const std::string& path_;
  ArrayTable table_;
  std::size_t total_ = 0;  ///< columns so far
  std::vector<const NamedArray*> left_out_;
  std::set<std::string> taken_;
};

}  // namespace

std::string why_no_table(const std::vector<NamedArray>& arrays) {
  std::vector<const NamedArray*> pointers;
  for (const NamedArray& array : arrays) pointers.push_back(&array);
  const auto all = [&](auto holds) { return std::all_of(arrays.begin(), arrays.end(), holds); };
  const auto is_deep = [](const NamedArray& array) { return squeezed(array.shape).size() > 2; };
  const auto is_empty = [](const NamedArray& array) { return elements(array.shape) == 0.0; };
  const auto is_wide = [](const NamedArray& array) {
    const Shape shape = squeezed(array.shape);
    return shape.size() > 2 || (shape.size() == 2 && std::min(shape[0], shape[1]) > kMostArrayColumns);
  };
  const std::string found = "; it holds " + listed_arrays(pointers);
  if (all([&](const NamedArray& array) { return is_empty(array) || is_deep(array); }) && !all(is_deep))
    return "has no rows: its arrays are empty, so nothing was recorded" + found;
  if (all(is_deep))
    return "holds no table: its arrays have three dimensions or more, but a log needs a vector of times "
           "and a matrix of positions (rows x joints)" +
           found;
  if (all([&](const NamedArray& array) { return array.unwritten || is_deep(array) || is_empty(array); }))
    return "has space for rows, but none was written: the recorder stopped before it stored the first rows" +
           found;
  if (all(is_wide))
    return fmt::format(
               "holds no table of a log: such a table has at most {} columns and one row for each time",
               kMostArrayColumns) +
           found;
  return "is cut before its first row; nothing can be read from it" + found;
}

std::vector<ArrayBand> bands_of(const ArrayTable& table) {
  std::vector<ArrayBand> bands;
  for (const TableArray& used : table.arrays)
    bands.push_back({used.array, used.channel_major, 0, used.rows_held, {}});
  return bands;
}

ArrayTable table_of(const std::vector<NamedArray>& arrays, const std::string& path) {
  return TableMaker(arrays, path).run();
}

}  // namespace faultline
