// SPDX-License-Identifier: MIT
#include "apps/python/log_handle.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "apps/python/bindings.hpp"
#include "apps/work/robot_log.hpp"
#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "lib/core/issue.hpp"
#include "lib/core/json_values.hpp"
#include "lib/core/outgoing/json_text.hpp"
#include "lib/log/log.hpp"
#include "lib/log/mapped_source.hpp"
#include "lib/log/recorder/corrected_source.hpp"
#include "lib/robot/chain.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {

namespace py = pybind11;
using Json = nlohmann::ordered_json;

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

/// Hashes names, units and values of the columns in order (SHA-256): the identity of a log without a file.
std::string sha256_of(const std::vector<ColumnView>& columns) {
  Sha256 hash;
  for (const ColumnView& column : columns) {
    hash.update(fmt::format("{}:{}{}:{}{}\n", column.column.name.size(), column.column.name,
                            column.column.unit.size(), column.column.unit, column.values.size()));
    hash.update(bytes_of(column.values));
  }
  return hash.hex();
}

/// A log of columns in memory, read without a copy of the whole: only one block at a time is copied.
class ColumnReader : public RawReader {
 public:
  /// The values must outlive the reader and not change. Throws Error(input) for columns of unequal length.
  ColumnReader(std::vector<ColumnView> columns, std::string name)
      : columns_(std::move(columns)), rows_(rows_of(columns_, name)) {
    wanted_.assign(columns_.size(), true);
    for (const ColumnView& column : columns_) names_.push_back(column.column);
    identity_.path = std::move(name);
    identity_.format = "arrays";
  }

  const std::vector<RawColumn>& columns() const override { return names_; }
  bool next(RawBlock& block, int max_rows) override {
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

  void rewind() override {
    identity_.rows_read = 0;
    issues_ = {};
  }

  const Issues& issues() const override { return issues_; }
  double share_read() const override {
    return rows_ > 0 ? static_cast<double>(identity_.rows_read) / static_cast<double>(rows_) : 1.0;
  }

 private:
  void tell_text() {
    for (std::size_t i = 0; i < columns_.size(); ++i)
      if (columns_[i].is_text && wanted_[i] && issues_.find("not_a_number", names_[i].name) == nullptr)
        issues_.add(make_issue("not_a_number", Severity::warning,
                               "the column holds no numbers; all its cells are missing", names_[i].name));
  }

  std::vector<ColumnView> columns_;
  std::vector<RawColumn> names_;
  Issues issues_;
  std::int64_t rows_ = 0;
};

}  // namespace

LogHandle::LogHandle(std::string name, const std::vector<std::string>& names,
                     const std::vector<std::string>& units, const py::list& arrays, int run)
    : name_(std::move(name)) {
  parts_.run = run;
  for (std::size_t i = 0; i < names.size(); ++i) {
    ColumnView view{{names[i], units[i]}, {}, arrays[i].is_none()};
    if (!view.is_text) {
      const auto array = py::cast<py::array_t<double, py::array::c_style>>(arrays[i]);
      view.values = {array.data(), static_cast<std::size_t>(array.size())};
      arrays_.push_back(array);
    }
    columns_.push_back(std::move(view));
  }
  if (arrays_.empty())
    throw Error(ErrorCode::input, name_,
                "has no column of numbers; a log needs at least a time and a position");
}

std::vector<std::string> LogHandle::files() const {
  if (!is_file()) return {};
  std::vector<std::string> files{name_};
  for (const auto* more : {&parts_.join, &parts_.then}) files.insert(files.end(), more->begin(), more->end());
  return files;
}

std::unique_ptr<RawReader> LogHandle::open_columns(const RecordingChoice& choice) const {
  if (is_file()) return open_parts(name_, parts_, choice);
  return std::make_unique<ColumnReader>(columns_, name_);
}

std::unique_ptr<LogSource> LogHandle::open_channels(const Robot* robot, bool extra,
                                                    ProgressRelay& watch) const {
  MappedSourceOptions options;
  if (robot) options.columns = robot->log.columns;
  options.run = parts_.run;
  options.keep_extra = extra;
  auto source =
      std::make_unique<MappedSource>(open_columns(robot ? robot->log.recording : RecordingChoice{}), options);
  return interruptible(mended(std::move(source), robot ? sliding_joints(robot->chain) : std::vector<bool>{}),
                       watch, true);
}

std::unique_ptr<LogSource> LogHandle::open(const Robot& robot, ProgressRelay& watch,
                                           bool reports_progress) const {
  return interruptible(robot_log_of(open_columns(robot.log.recording), robot, parts_.run), watch,
                       reports_progress);
}

std::optional<Robot> robot_named(const std::string& robot) {
  if (robot.empty()) return {};
  return load_robot_file(robot);
}

namespace {

/// Returns the channels in SI by name, then the report of reading them, as JSON.
py::tuple read_channels(const LogHandle& handle, const std::string& robot_name, bool extra,
                        const py::object& progress) {
  auto [log, facts] = watched(progress, [&](ProgressRelay& watch) {
    const std::optional<Robot> robot = robot_named(robot_name);
    const auto source = handle.open_channels(robot ? &*robot : nullptr, extra, watch);
    Log read = read_all(*source);
    const LogIdentity& identity = source->identity();
    return std::pair(std::move(read),
                     json_text(Json{{"path", identity.path},
                                    {"sha256", identity.sha256},
                                    {"format", identity.format},
                                    {"rows", identity.rows_read},
                                    {"issues", list_of<Json>(source->issues().all(), issue_json)}}));
  });
  py::dict channels, units;
  channels["t"] = owned_array(std::move(log.time));
  for_each_joint_channel(log, [&](std::vector<double>& values, Channel channel) {
    channels[to_string(channel).c_str()] = owned_array(std::move(values));
  });
  for (ExtraChannel& one : log.extra) {
    units[one.name.c_str()] = one.unit;
    channels[one.name.c_str()] = owned_array(std::move(one.values));
  }
  return py::make_tuple(channels, units, facts);
}

LogSelection selection(std::vector<std::string> then, std::vector<std::string> join, const std::string& by,
                       int run) {
  LogSelection parts;
  parts.then = std::move(then);
  parts.join = std::move(join);
  parts.run = run;
  if (by == "row")
    parts.by = JoinBy::row;
  else if (by == "time")
    parts.by = JoinBy::time;
  else if (by != "auto")
    throw Error(ErrorCode::usage, "join_by",
                "\"" + by + "\" is not a way to join; expected auto, row or time");
  if (run < 0) throw Error(ErrorCode::usage, "run", "counts from 1; 0 reads every run");
  return parts;
}

std::vector<std::string> column_names(const LogHandle& handle) {
  const py::gil_scoped_release others_run;
  std::vector<std::string> names;
  const std::unique_ptr<RawReader> reader = handle.open_columns();
  for (const RawColumn& column : reader->columns()) names.push_back(column.name);
  return names;
}

}  // namespace

void bind_log(py::module_& module) {
  py::class_<LogHandle, std::shared_ptr<LogHandle>>(module, "Log",
                                                    "A log: a file with its parts, or columns in memory.")
      .def(py::init([](std::string path, std::vector<std::string> then, std::vector<std::string> join,
                       const std::string& join_by, int run) {
             return std::make_shared<LogHandle>(std::move(path),
                                                selection(std::move(then), std::move(join), join_by, run));
           }),
           py::arg("path"), py::arg("then"), py::arg("join"), py::arg("join_by"), py::arg("run"))
      .def_static(
          "of_columns",
          [](std::string name, const std::vector<std::string>& names, const std::vector<std::string>& units,
             const py::list& arrays,
             int run) { return std::make_shared<LogHandle>(std::move(name), names, units, arrays, run); },
          py::arg("name"), py::arg("names"), py::arg("units"), py::arg("arrays"), py::arg("run"),
          "A log of contiguous float64 arrays, None for a column of text.")
      .def_property_readonly("name", &LogHandle::name, "The path, or the name given to columns in memory.")
      .def_property_readonly("is_file", &LogHandle::is_file, "Whether it is a file.")
      .def("columns", &column_names, "Names of the columns, as the log calls them.")
      .def("read", &read_channels, py::arg("robot"), py::arg("extra"), py::arg("progress"),
           "Channels in SI by name, units of the others, and how it was read as JSON.");
}

}  // namespace faultline
