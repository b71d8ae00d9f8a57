// SPDX-License-Identifier: MIT
#include "formats/diadem/diadem_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "formats/diadem/diadem_files.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"
#include "lib/log/channel_names.hpp"
#include "lib/log/units.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostDiademNames = 8;  ///< channels that a message lists by name

/// Returns the number N of a file name with "#N" before its ending, as of the motors of KUKA; 0 for none.
int axis_in_name(const std::string& path) {
  const std::string name = fs::path(path).filename().string();
  const std::size_t mark = name.find_last_of('#');
  int axis = 0;
  if (mark == std::string::npos) return 0;
  const auto [stop, error] = std::from_chars(name.data() + mark + 1, name.data() + name.size(), axis);
  const auto length = static_cast<std::size_t>(stop - name.data());
  constexpr int kMostAxes = 64;
  const bool ends = length == name.size() || name[length] == '.';
  return error == std::errc{} && ends && axis > 0 && axis <= kMostAxes ? axis : 0;
}

/// Lists names of channels, the first ones in quotes.
class DiademNames {
 public:
  void add(const std::string& name) {
    if (++count_ <= kMostDiademNames)
      text_ += (count_ > 1 ? ", " : "") + ("\"" + shortened(name, kLongestName) + "\"");
  }
  std::string text() const {
    return text_ + (count_ > kMostDiademNames ? fmt::format(" and {} more", count_ - kMostDiademNames) : "");
  }
  const char* verb() const { return count_ == 1 ? "was" : "were"; }
  bool empty() const { return count_ == 0; }

 private:
  std::size_t count_ = 0;
  std::string text_;
};

/// Length, start and step of a group of channels; the step is 0 if no time channel states it.
using DiademClock = std::tuple<std::int64_t, double, double, std::size_t>;

class DiademTableMaker {
 public:
  DiademTableMaker(const DiademHeader& header, const std::string& path)
      : channels_(header.channels), path_(path), file_of_(channels_.size(), -1) {}

  DiademTable run() {
    for (std::size_t i = 0; i < channels_.size(); ++i) find_file(i);
    report_damaged();
    for (int file = 0; file < std::ssize(table_.files); ++file) measure_blocks(file);
    choose_group();
    for (const std::size_t i : chosen_) add_place(channels_[i], file_of_[i]);
    name_columns();
    count_held();
    report_trailing_bytes();
    return std::move(table_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw Error(ErrorCode::input, path_, what); }

  bool is_usable(std::size_t i) const {
    return channels_[i].damage.empty() && (channels_[i].implicit || file_of_[i] >= 0);
  }

  void find_file(std::size_t i) {
    const DiademChannel& channel = channels_[i];
    if (channel.implicit || channel.file.empty()) return;
    const auto [known, fresh] = index_of_.emplace(channel.file, -1);
    const std::string name = shortened(channel.file, kLongestName);
    if (fresh && !is_bare_name(channel.file))
      fail(fmt::format(
          "names the data file \"{}\" in a line 211, which is a path; only a file in the folder of "
          "the header is read. Copy that file beside the header and write its bare name there",
          name));
    if (fresh) {
      const std::vector<std::string> found = data_files_named(channel.file, path_);
      if (found.size() > 1)
        fail(
            fmt::format("names the data file \"{}\", but {} files beside it have this name except for "
                        "capitals; remove all but the right one",
                        name, found.size()));
      if (!found.empty()) known->second = add_file(found.front());
    }
    file_of_[i] = known->second;
  }

  int add_file(const std::string& path) {
    for (int k = 0; k < std::ssize(table_.files); ++k)
      if (table_.files[k].path == path) return k;
    std::error_code error;
    table_.files.push_back({path, static_cast<std::int64_t>(fs::file_size(path, error))});
    if (error) table_.files.back().bytes = 0;
    return static_cast<int>(table_.files.size()) - 1;
  }

  /// Reports the channels that cannot be read; throws when no data file exists.
  void report_damaged() {
    std::map<std::string, DiademNames> damaged, missing;
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      const DiademChannel& channel = channels_[i];
      if (!channel.damage.empty()) damaged[channel.damage].add(channel.name);
      if (!channel.implicit && !channel.file.empty() && file_of_[i] < 0)
        missing[shortened(channel.file, kLongestName)].add(channel.name);
    }
    if (table_.files.empty() && !missing.empty())
      fail(
          fmt::format("names the data file \"{}\" (line 211), which is not in the folder of the header; copy "
                      "it there under this name, together with the header",
                      missing.begin()->first));
    report_by_reason("data_file_missing", Severity::severe, missing,
                     "the data file {} is not beside the header");
    report_by_reason("channel_left_out", Severity::warning, damaged, "{}");
  }

  /// Reports the channels that were left out, with the first reasons; `sentence` contains the reason.
  void report_by_reason(const char* code, Severity severity,
                        const std::map<std::string, DiademNames>& by_reason, std::string_view sentence) {
    std::size_t reasons = 0;
    for (const auto& [reason, names] : by_reason) {
      if (++reasons > kMostDiademNames) break;
      table_.issues.add(make_issue(code, severity,
                                   fmt::format("{} {} left out: {}", names.text(), names.verb(),
                                               fmt::format(fmt::runtime(sentence), reason)),
                                   reason));
    }
    if (reasons > kMostDiademNames)
      table_.issues.add(make_issue(code, severity,
                                   fmt::format("further channels were left out for {} other reasons",
                                               by_reason.size() - kMostDiademNames)));
  }

  void measure_blocks(int file) {
    std::vector<const DiademChannel*> of_file;
    for (std::size_t i = 0; i < channels_.size(); ++i)
      if (file_of_[i] == file) of_file.push_back(&channels_[i]);
    block_width_.push_back(block_width_of(of_file, table_.files[static_cast<std::size_t>(file)], path_));
  }

  bool is_time(const DiademChannel& channel) const {
    const auto unit = known_unit(channel.unit);
    if (channel.implicit && unit && unit->dimension == Dimension::time) return true;
    return find_time_column({split_unit(channel.name).name}) >= 0;
  }

  /// Returns the clock of channel `i`: that of the last time channel of its length before it, else of the
  /// first one behind it.
  DiademClock clock_of(std::size_t i, const std::vector<std::size_t>& times) const {
    const DiademChannel& channel = channels_[i];
    const DiademClock none{channel.values, 0.0, 0.0, channels_.size()};
    std::optional<std::size_t> best;
    for (const std::size_t time : times) {
      if (channels_[time].values != channel.values) continue;
      if (time > i && best) break;
      best = time;
    }
    if (!best) return none;
    const DiademChannel& time = channels_[*best];
    if (!time.implicit) return {channel.values, 0.0, 0.0, *best};
    return {channel.values, time.start, time.step, channels_.size()};
  }

  /// Chooses the clock that most channels share, the first of equals.
  void choose_group() {
    std::vector<std::size_t> times;
    for (std::size_t i = 0; i < channels_.size(); ++i)
      if (is_usable(i) && channels_[i].values > 0 && is_time(channels_[i])) times.push_back(i);
    std::map<DiademClock, std::vector<std::size_t>> groups;
    std::vector<DiademClock> order;
    DiademNames empty;
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      if (!is_usable(i)) continue;
      if (channels_[i].values == 0) empty.add(channels_[i].name);
      if (channels_[i].values == 0 || is_time(channels_[i])) continue;
      auto& group = groups[clock_of(i, times)];
      if (group.empty()) order.push_back(clock_of(i, times));
      group.push_back(i);
    }
    if (order.empty())
      fail(
          "has no channel with values besides the time, so nothing can be read. If the data file holds some, "
          "the recording was not finished: copy header and data file from the controller again");
    const DiademClock chosen = *std::max_element(
        order.begin(), order.end(),
        [&](const DiademClock& a, const DiademClock& b) { return groups[a].size() < groups[b].size(); });
    table_.rows = std::get<0>(chosen);
    chosen_ = groups[chosen];
    for (const std::size_t time : times)
      if (clock_of(time, {time}) == chosen) chosen_.push_back(time);
    std::sort(chosen_.begin(), chosen_.end());
    report_left_out(groups, chosen, empty);
  }

  void report_left_out(const std::map<DiademClock, std::vector<std::size_t>>& groups,
                       const DiademClock& chosen, const DiademNames& empty) {
    if (!empty.empty())
      table_.issues.add(make_issue("array_left_out", Severity::note,
                                   fmt::format("{} {} left out: no values", empty.text(), empty.verb())));
    DiademNames others;
    std::string clocks;
    for (const auto& [clock, group] : groups) {
      if (clock == chosen) continue;
      for (const std::size_t i : group) others.add(channels_[i].name);
      clocks += (clocks.empty() ? "" : ", ") + clock_text(clock);
    }
    if (!others.empty())
      table_.issues.add(make_issue(
          "signal_left_out", Severity::warning,
          fmt::format(
              "{} {} left out: the table has {}, these channels {}; save signals of another length or "
              "step into a separate file and --join it by time",
              others.text(), others.verb(), clock_text(chosen), shortened(clocks, kMostClockText))));
  }

  static std::string clock_text(const DiademClock& clock) {
    const auto& [values, start, step, time] = clock;
    return fmt::format("{} values", values) + (step != 0.0 ? fmt::format(" at a step of {}", step) : "");
  }

  void add_place(const DiademChannel& channel, int file) {
    DiademColumn place{file, channel.type,   channel.in_blocks, 0,
                       0,    channel.values, channel.start,     channel.step};
    RawColumn column{channel.name, channel.unit};
    if (column.unit.empty()) std::tie(column.name, column.unit) = name_and_unit(channel.name);
    const auto unit = known_unit(column.unit);
    if (channel.implicit) {
      place.file = -1;
      const bool is_clock = unit && unit->dimension == Dimension::time && is_time(channel);
      if (is_clock && !has_clock_) {
        place.start *= unit->factor, place.step *= unit->factor;
        column.unit = "s";
        column.meaning = Channel{};
        has_clock_ = true;
      }
    } else {
      const auto size = static_cast<std::int64_t>(size_of(channel.type));
      const std::int64_t bytes = table_.files[static_cast<std::size_t>(file)].bytes;
      place.begin = (channel.first - 1) * size;
      place.stride = channel.in_blocks ? block_width_[static_cast<std::size_t>(file)] * size : size;
      place.held = place.begin + size > bytes ? 0 : (bytes - place.begin - size) / place.stride + 1;
      place.held = std::min(place.held, table_.rows);
    }
    table_.columns.push_back(column);
    table_.places.push_back(place);
  }

  static std::pair<std::string, std::string> name_and_unit(const std::string& name) {
    const NameAndUnit parts = split_unit(name);
    return {parts.name, parts.unit};
  }

  /// Numbers names that several columns share, adds the axis of the file's name, and makes all names differ.
  void name_columns() {
    std::map<std::string, int> uses, given;
    for (RawColumn& column : table_.columns) {
      if (column.name.empty()) column.name = "channel";
      ++uses[column.name];
    }
    const int axis = axis_in_name(path_);
    DiademNames repeated;
    std::set<std::string> taken;
    for (RawColumn& column : table_.columns) {
      const std::string name = column.name;
      const bool is_time = column.meaning || find_time_column({name}) >= 0;
      if (uses[name] > 1) column.name += fmt::format("_{}", ++given[name]);
      if (uses[name] > 1 && given[name] == 1) repeated.add(name);
      if (axis > 0 && !is_time && !parse_name(name).number) column.name += fmt::format("_A{}", axis);
      while (!taken.insert(column.name).second) column.name += " (again)";
    }
    if (!repeated.empty())
      table_.issues.add(make_issue(
          "names_repeated", Severity::warning,
          fmt::format("several channels are called {}; they were numbered in their order. Check that this is "
                      "the order of the joints, or name the columns in the robot file: [log.columns] q1 = "
                      "{{name = \"...\"}}",
                      repeated.text())));
  }

  /// Counts the rows that the data files hold, and reports columns that end before.
  void count_held() {
    std::int64_t held = 0, with_time = table_.rows;
    for (std::size_t c = 0; c < table_.places.size(); ++c) {
      const DiademColumn& place = table_.places[c];
      if (place.file < 0) continue;
      held = std::max(held, place.held);
      if (!has_clock_ && find_time_column({table_.columns[c].name}) >= 0)
        with_time = std::min(with_time, place.held);
    }
    table_.rows_held = std::min(held, with_time);
    if (table_.rows_held == 0)
      fail(
          "has data files that end before their first row, so nothing can be read; copy them from the "
          "controller again");
    for (std::size_t c = 0; c < table_.places.size(); ++c) {
      const std::int64_t lost = table_.rows_held - table_.places[c].held;
      if (table_.places[c].file < 0 || lost <= 0) continue;
      const std::string& name = table_.columns[c].name;
      table_.issues.add(
          {"file_truncated", name, Severity::severe,
           fmt::format("values of \"{}\" could not be read from row {} on and count as missing: "
                       "the data file ends before them",
                       shortened(name, kLongestName), table_.places[c].held + 1),
           table_.places[c].held + 1, kNan, lost});
    }
  }

  /// Reports bytes of a data file behind the last value that the header states.
  void report_trailing_bytes() {
    for (int file = 0; file < std::ssize(table_.files); ++file) {
      double used = 0.0;  // bytes; counts and widths together can exceed an integer
      for (std::size_t i = 0; i < channels_.size(); ++i) {
        if (file_of_[i] != file) continue;
        const DiademChannel& channel = channels_[i];
        const double size = static_cast<double>(size_of(channel.type)),
                     values = static_cast<double>(channel.values);
        const double width = static_cast<double>(block_width_[static_cast<std::size_t>(file)]);
        const double end =
            channel.in_blocks ? values * width : static_cast<double>(channel.first - 1) + values;
        used = std::max(used, channel.damage.empty() ? end * size : std::numeric_limits<double>::infinity());
      }
      const DiademFile& data = table_.files[static_cast<std::size_t>(file)];
      const std::string name = fs::path(data.path).filename().string();
      if (static_cast<double>(data.bytes) > used)
        table_.issues.add(
            make_issue("trailing_bytes", Severity::warning,
                       fmt::format("\"{}\" holds {:.0f} bytes behind the last value that the header "
                                   "states; they were ignored",
                                   shortened(name, kLongestName), static_cast<double>(data.bytes) - used),
                       name));
    }
  }

  static constexpr std::size_t kMostClockText = 200;  ///< characters of a list of other lengths and steps

  const std::vector<DiademChannel>& channels_;
  const std::string& path_;
  std::vector<int> file_of_;               ///< by channel: its data file, -1 for none
  std::map<std::string, int> index_of_;    ///< data file by its name in the header
  std::vector<std::int64_t> block_width_;  ///< by file: values in a row of blocks
  std::vector<std::size_t> chosen_;        ///< channels of the table
  bool has_clock_ = false;                 ///< an implicit channel is the time
  DiademTable table_;
};

}  // namespace

DiademTable diadem_table(const DiademHeader& header, const std::string& path) {
  return DiademTableMaker(header, path).run();
}

}  // namespace faultline
