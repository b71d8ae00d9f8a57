// SPDX-License-Identifier: MIT
#include "apps/python/log_handle.hpp"

#include <pybind11/stl.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "apps/python/bindings.hpp"
#include "apps/python/owned_array.hpp"
#include "apps/work/robot_log.hpp"
#include "lib/core/error.hpp"
#include "lib/core/issue_json.hpp"
#include "lib/core/json_values.hpp"
#include "lib/core/outgoing/json_text.hpp"
#include "lib/log/log_channels.hpp"
#include "lib/log/mapped_source.hpp"
#include "lib/log/recorder/corrected_source.hpp"
#include "lib/robot/axis_units.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {

namespace py = pybind11;
using Json = nlohmann::ordered_json;

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

std::unique_ptr<LogSource> LogHandle::open(const Robot& robot) const {
  return robot_log_of(open_columns(robot.log.recording), robot, parts_.run);
}

std::unique_ptr<LogSource> LogHandle::open(const Robot& robot, ProgressRelay& watch,
                                           bool reports_progress) const {
  return interruptible(open(robot), watch, reports_progress);
}

std::optional<Robot> robot_named(const std::string& robot) {
  if (robot.empty()) return {};
  return load_robot_file(robot);
}

namespace {

struct WholeLog {
  Log log;
  LogIdentity identity;
  Issues issues;
};

WholeLog whole(const LogHandle& handle, const std::optional<Robot>& robot, bool keep_extra,
               ProgressRelay& watch) {
  MappedSourceOptions options;
  if (robot) options.columns = robot->log.columns;
  options.run = handle.parts().run;
  options.keep_extra = keep_extra;
  const auto source = interruptible(
      mended(std::make_unique<MappedSource>(
                 handle.open_columns(robot ? robot->log.recording : RecordingChoice{}), options),
             robot ? sliding_joints(robot->chain) : std::vector<bool>{}),
      watch, true);
  WholeLog out;
  out.log = read_all(*source);
  out.identity = source->identity();
  out.issues = source->issues();
  return out;
}

/// Returns the channels in SI by name, then the report of reading them, as JSON.
py::tuple read_channels(const LogHandle& handle, const std::string& robot, bool extra,
                        const py::object& progress) {
  WholeLog read = watched(
      progress, [&](ProgressRelay& watch) { return whole(handle, robot_named(robot), extra, watch); });
  py::dict channels, units;
  channels["t"] = owned_array(std::move(read.log.time));
  for_each_joint_channel(read.log, [&](std::vector<double>& values, Channel channel) {
    channels[to_string(channel).c_str()] = owned_array(std::move(values));
  });
  for (ExtraChannel& one : read.log.extra) {
    units[one.name.c_str()] = one.unit;
    channels[one.name.c_str()] = owned_array(std::move(one.values));
  }
  const std::string facts = json_text(Json{{"path", read.identity.path},
                                           {"sha256", read.identity.sha256},
                                           {"format", read.identity.format},
                                           {"rows", read.identity.rows_read},
                                           {"issues", list_of<Json>(read.issues.all(), issue_json)}});
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
