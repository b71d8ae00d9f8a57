// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/python/bindings.hpp"
#include "apps/python/log_handle.hpp"
#include "apps/work/conversion.hpp"
#include "apps/work/diagnosis_recording.hpp"
#include "lib/core/error.hpp"
#include "lib/core/issue.hpp"
#include "lib/core/json_values.hpp"
#include "lib/core/outgoing/json_text.hpp"

namespace faultline {
namespace {

namespace py = pybind11;
using Json = nlohmann::ordered_json;

/// Returns what became of the log as JSON.
std::string convert(const std::shared_ptr<LogHandle>& log, const std::string& out,
                    const std::string& robot_name, const std::string& diagnosis, const py::object& progress) {
  if (out == "-")
    throw Error(ErrorCode::usage, "output", "cannot be standard output; give the name of a file");
  FileUse()
      .reads("the log", log->files())
      .reads("robot", robot_name)
      .reads("diagnosis", diagnosis)
      .writes("output", out)
      .claim();
  return watched(progress, [&](ProgressRelay& watch) {
    const std::optional<Robot> robot = robot_named(robot_name);
    std::optional<std::vector<LogEvent>> events;
    if (!diagnosis.empty()) events = events_of_file(diagnosis);
    const auto source = log->open_channels(robot ? &*robot : nullptr, true, watch);
    const Conversion done = convert_log(*source, out, events, {});
    return json_text(Json{{"path", out},
                          {"rows_read", done.rows_read},
                          {"rows_written", done.rows_written},
                          {"lost_values", done.lost_values},
                          {"issues", list_of<Json>(done.issues.all(), issue_json)}});
  });
}

}  // namespace

void bind_convert(py::module_& module) {
  module.def("convert", &convert, py::arg("log"), py::arg("output"), py::arg("robot"), py::arg("diagnosis"),
             py::arg("progress"), "Writes a log in another format.");
}

}  // namespace faultline
