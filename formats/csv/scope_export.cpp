// SPDX-License-Identifier: MIT
// The layout, from the manual of Beckhoff's TE13xx ("Export in csv") and exports in public: lines on the
// project; lines on the channels, each with its key (Name, Data-Type, Unit, ..) above every time column; the
// values.
#include "formats/csv/scope_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "lib/core/text.hpp"
#include "lib/log/channel_names.hpp"
#include "lib/log/time_axis.hpp"
#include "lib/log/units.hpp"

namespace faultline {
namespace {

constexpr std::string_view kScopeName = "Name";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
/// Name of the time column, which the file does not name.
constexpr const char* kScopeTime = "Scope time";

using ScopeFields = std::vector<std::string_view>;

/// Fields of one channel in the lines above the values.
std::string_view field_at(const ScopeFields* fields, std::size_t at) {
  return fields && at < fields->size() ? (*fields)[at] : std::string_view{};
}

/// The lines on the channels, and where the values begin.
struct ScopeHead {
  const ScopeFields *names = nullptr, *symbols = nullptr, *units = nullptr, *periods = nullptr;
  const ScopeFields *offsets = nullptr, *factors = nullptr, *types = nullptr;
  bool has_project = false;  ///< lines on the project, with its beginning
  std::size_t data = 0;      ///< line of the first values

  bool is_scope() const {
    if (!names) return false;
    return has_project || symbols || types || periods ||
           std::count(names->begin(), names->end(), kScopeName) > 1;
  }
};

void take_key_line(const ScopeFields& fields, ScopeHead& head) {
  const std::string_view key = fields[0];
  if (key == kScopeName) head.names = &fields;
  if (key == "SymbolName") head.symbols = &fields;
  if (key == "Unit") head.units = &fields;
  if (key == "SampleTime[ms]") head.periods = &fields;
  if (key == "Offset") head.offsets = &fields;
  if (key == "ScaleFactor") head.factors = &fields;
  if (key == "Data-Type") head.types = &fields;
  head.has_project = head.has_project || key == "Starttime of export" || key == "StartRecord";
}

/// Reads the lines down to the first one that begins with a number.
ScopeHead scope_head(std::span<const CsvLine> lines, char decimal) {
  ScopeHead head;
  for (head.data = 0; head.data < lines.size(); ++head.data) {
    const CsvLine& line = lines[head.data];
    if (line.comment || line.fields.empty()) continue;
    if (head.names && read_cell(line.fields[0], decimal).kind == CellKind::number) break;
    take_key_line(line.fields, head);
  }
  return head;
}

/// Channels with one time column.
struct ScopeGroup {
  std::size_t time = 0;               ///< field
  std::vector<std::size_t> channels;  ///< fields
  std::vector<double> times;          ///< of the first rows
  int joint_signals = 0;              ///< channels whose names are those of joint signals
  std::string_view period;            ///< as the file writes it

  /// Usual step of the times; infinite for fewer than two.
  double step() const {
    std::vector<double> increasing;
    for (const double time_of_row : times)
      if (std::isfinite(time_of_row) && (increasing.empty() || time_of_row > increasing.back()))
        increasing.push_back(time_of_row);
    const double step = median_step(increasing);
    return std::isnan(step) ? std::numeric_limits<double>::infinity() : step;
  }
  bool has_same_times(const ScopeGroup& other) const {
    return period == other.period &&
           std::equal(times.begin(), times.end(), other.times.begin(), other.times.end(),
                      [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); });
  }
};

bool is_joint_signal(const ScopeHead& head, std::size_t field) {
  return parse_name(std::string(field_at(head.names, field))).quantity ||
         parse_name(std::string(field_at(head.symbols, field))).quantity;
}

/// Returns one group for each time column of the file.
std::vector<ScopeGroup> groups_of(const ScopeHead& head, std::span<const CsvLine> rows, char decimal) {
  std::vector<ScopeGroup> groups;
  for (std::size_t f = 0; f < head.names->size(); ++f) {
    if ((*head.names)[f] == kScopeName) {
      groups.push_back({f, {}, {}, 0, field_at(head.periods, f + 1)});
    } else if (!(*head.names)[f].empty()) {
      groups.back().channels.push_back(f);
      groups.back().joint_signals += is_joint_signal(head, f);
    }
  }
  std::erase_if(groups, [](const ScopeGroup& group) { return group.channels.empty(); });
  for (ScopeGroup& group : groups)
    for (const CsvLine& row : rows)
      if (!row.comment && !row.fields.empty())
        group.times.push_back(
            group.time < row.fields.size() ? read_cell(row.fields[group.time], decimal).value : kNan);
  return groups;
}

/// Puts channels with the same times together; stops when there are more groups than a file may have.
std::vector<ScopeGroup> merged_groups(std::vector<ScopeGroup> groups) {
  std::vector<ScopeGroup> different;
  for (ScopeGroup& group : groups) {
    const auto same = std::find_if(different.begin(), different.end(),
                                   [&](const ScopeGroup& other) { return other.has_same_times(group); });
    if (same == different.end()) {
      different.push_back(std::move(group));
      if (different.size() > kMostOwnTimes + 1) break;
      continue;
    }
    same->channels.insert(same->channels.end(), group.channels.begin(), group.channels.end());
    same->joint_signals += group.joint_signals;
  }
  return different;
}

/// Returns the unit in "V (Voltage)"; empty for "(None)".
std::string scope_unit(std::string_view text) {
  return std::string(without_blanks(text.substr(0, text.find('('))));
}

/// Gives each channel a name of its own, with the unit that the name may hold: its name, else that of its
/// symbol, else one with its column.
class ScopeNames {
 public:
  explicit ScopeNames(const ScopeHead& head) : head_(head) {
    taken_.insert(kScopeTime);
    for (const std::string_view name : *head.names) ++uses_[name];
  }

  NameAndUnit name_of(std::size_t field) {
    std::string name((*head_.names)[field]);
    const std::string symbol(field_at(head_.symbols, field));
    if (uses_.at(name) > 1 && !symbol.empty()) name = symbol;
    NameAndUnit parts = split_unit(name);
    if (!taken_.insert(parts.name).second) {
      parts.name += fmt::format(" column {}", field + 1);
      taken_.insert(parts.name);
    }
    return parts;
  }

 private:
  const ScopeHead& head_;
  std::map<std::string_view, int> uses_;  ///< of each name in the file
  std::set<std::string> taken_;
};

OwnTimeColumns scope_columns_of(const ScopeGroup& group, const ScopeHead& head, bool filetime,
                                ScopeNames& names) {
  OwnTimeColumns own;
  own.columns.push_back({kScopeTime, filetime ? "s" : "ms", Channel{}});
  own.value_fields.push_back(static_cast<int>(group.time));
  for (const std::size_t field : group.channels) {
    const NameAndUnit parts = names.name_of(field);
    const std::string unit = scope_unit(field_at(head.units, field));
    own.columns.push_back({parts.name, unit.empty() ? parts.unit : unit});
    own.value_fields.push_back(static_cast<int>(field));
  }
  return own;
}

void note_scaling(const ScopeHead& head, char decimal, Issues& issues) {
  std::string_view first;
  int scaled = 0;
  for (std::size_t f = 0; f < head.names->size(); ++f) {
    const Cell offset = read_cell(field_at(head.offsets, f), decimal);
    const Cell factor = read_cell(field_at(head.factors, f), decimal);
    const bool is_scaled = (offset.kind == CellKind::number && offset.value != 0.0) ||
                           (factor.kind == CellKind::number && factor.value != 1.0);
    if (is_scaled && scaled++ == 0) first = (*head.names)[f];
  }
  if (scaled == 0) return;
  issues.add(
      {"scope_scaling", "", Severity::note,
       fmt::format("{}, first \"{}\", have an offset or a scale factor in the header, and the file does "
                   "not show whether the values contain it (option \"Scale values before export\"); the "
                   "values were read as they are. If they are raw, state scale and offset in the robot "
                   "file, [log.columns]",
                   counted(scaled, "channel"), shortened(std::string(first), kLongestName))});
}

void note_sample_times(const std::vector<ScopeGroup>& groups, Issues& issues) {
  const bool of_joints = std::any_of(groups.begin() + 1, groups.end(),
                                     [](const ScopeGroup& group) { return group.joint_signals > 0; });
  std::string steps;
  for (std::size_t i = 1; i < groups.size(); ++i)
    steps += fmt::format("{}{:.4g}", i > 1 ? ", " : "", groups[i].step());
  issues.add(
      {"scope_sample_times", "", of_joints ? Severity::warning : Severity::note,
       fmt::format("the channels have times of their own: the rows are those of {} with steps of {:.4g}; "
                   "the values of the others, with steps of {}, were taken at these times, linearly "
                   "between two of their samples. Record all joints with one sample time for a diagnosis "
                   "without interpolated values",
                   counted(std::ssize(groups[0].channels), "channel"), groups[0].step(), steps)});
}

/// Rows of a reader whose first column is the time.
class OwnTimeRows : public RawReader {
 public:
  explicit OwnTimeRows(std::unique_ptr<RawReader> reader) : reader_(std::move(reader)) {
    identity_ = reader_->identity();
  }

  const std::vector<RawColumn>& columns() const override { return reader_->columns(); }
  void want(const std::vector<bool>& columns) override { reader_->want(columns); }
  void code_texts(int column) override { reader_->code_texts(column); }
  bool next(RawBlock& block, int max_rows) override {
    while (reader_->next(block, max_rows)) {
      keep_own(block);
      identity_.rows_read = reader_->identity().rows_read;
      if (block.rows > 0) return true;
    }
    return false;
  }
  void rewind() override {
    reader_->rewind();
    latest_ = -std::numeric_limits<double>::infinity();
  }
  const Issues& issues() const override { return reader_->issues(); }
  double share_read() const override { return reader_->share_read(); }

 private:
  void keep_own(RawBlock& block) {
    std::vector<std::size_t> own;
    const std::vector<double>& times = block.columns[0];
    for (std::size_t row = 0; row < times.size(); ++row) {
      if (std::isnan(times[row]) || times[row] == latest_) continue;
      latest_ = times[row];
      own.push_back(row);
    }
    for (std::vector<double>& column : block.columns) {
      if (column.empty()) continue;
      for (std::size_t i = 0; i < own.size(); ++i) column[i] = column[own[i]];
      column.resize(own.size());
    }
    block.rows = static_cast<int>(own.size());
  }

  std::unique_ptr<RawReader> reader_;
  double latest_ = -std::numeric_limits<double>::infinity();  ///< time of the latest row
};

}  // namespace

bool begins_like_scope_export(std::string_view head) {
  if (head.starts_with(kByteOrderMark)) head.remove_prefix(kByteOrderMark.size());
  return head.starts_with(kScopeName);
}

bool find_scope_columns(std::span<const CsvLine> lines, CsvDialect& dialect) {
  const ScopeHead head = scope_head(lines, dialect.decimal);
  if (!head.is_scope()) return false;
  std::vector<ScopeGroup> groups = merged_groups(groups_of(head, lines.subspan(head.data), dialect.decimal));
  if (groups.empty()) return false;
  std::stable_sort(groups.begin(), groups.end(), [](const ScopeGroup& a, const ScopeGroup& b) {
    return std::tuple(-a.joint_signals, -std::ssize(a.channels), a.step()) <
           std::tuple(-b.joint_signals, -std::ssize(b.channels), b.step());
  });
  dialect.filetime = !groups[0].times.empty() && is_filetime(groups[0].times.front());
  dialect.time_column = 0;
  dialect.fields = static_cast<int>(head.names->size());
  dialect.has_header = dialect.ends_early = true;
  ScopeNames names(head);
  for (const ScopeGroup& group : groups)
    dialect.others.push_back(scope_columns_of(group, head, dialect.filetime, names));
  dialect.columns = dialect.others.front().columns;
  dialect.value_fields = dialect.others.front().value_fields;
  dialect.others.erase(dialect.others.begin());
  note_scaling(head, dialect.decimal, dialect.issues);
  if (groups.size() > 1) note_sample_times(groups, dialect.issues);
  dialect.data_begin = head.data < lines.size() ? lines[head.data].begin : lines.back().end;
  dialect.lines_before = static_cast<std::int64_t>(head.data);
  for (const CsvLine& line : lines.subspan(head.data))
    if (is_data(line, dialect.fields)) dialect.last_cells.add(line.fields.back(), dialect.decimal);
  return true;
}

std::unique_ptr<RawReader> rows_of_own_time(std::unique_ptr<RawReader> reader) {
  return std::make_unique<OwnTimeRows>(std::move(reader));
}

}  // namespace faultline
