// SPDX-License-Identifier: MIT
#include "lib/identify/identify.hpp"

#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/python/bindings.hpp"
#include "apps/python/log_handle.hpp"
#include "apps/work/file_use.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/outgoing/json_text.hpp"
#include "lib/identify/identification_json.hpp"
#include "lib/plausibility/plausible_units.hpp"
#include "lib/report/html/identification/identification_page.hpp"
#include "lib/report/identification_text.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

namespace py = pybind11;

using Logs = std::vector<std::shared_ptr<LogHandle>>;

constexpr std::array kMethods{IdentifyMethod::automatic, IdentifyMethod::weak_form,
                              IdentifyMethod::output_error};

std::shared_ptr<Identification> identify_logs(const Logs& handles, const std::string& robot_name,
                                              const std::string& output, const std::string& method,
                                              bool keep_all, bool force, int threads,
                                              const py::object& progress) {
  if (handles.empty()) throw Error(ErrorCode::usage, "identify", "was given no log");
  IdentifyOptions options;
  options.method = named("method", method, kMethods);
  options.keep_all = keep_all;
  options.threads = threads;
  return watched(progress, [&](ProgressRelay& watch) {
    FileUse files;
    for (const auto& log : handles) files.reads("the log", log->files());
    files.reads("the robot file", robot_name).writes("output", output).claim();
    const Robot robot = load_robot_file(robot_name);
    std::vector<std::unique_ptr<LogSource>> sources;
    std::vector<LogSource*> logs;
    for (const auto& handle : handles) {
      sources.push_back(handle->open(robot, watch, false));
      logs.push_back(sources.back().get());
    }
    if (!force) refuse_implausible_units(logs, robot);
    auto id = std::make_shared<Identification>(identify(logs, robot, options, watch.progress()));
    if (!output.empty()) write_file(output, robot_text_for(output, id->robot));
    return id;
  });
}

std::string html(const Identification& id) {
  const py::gil_scoped_release others_run;
  return render_identification_html(id);
}

}  // namespace

void bind_identify(py::module_& module) {
  py::class_<Identification, std::shared_ptr<Identification>>(module, "Identification",
                                                              "What was identified.")
      .def(
          "json", [](const Identification& id) { return json_text(to_json(id)); },
          "Schema faultline/identification/1.")
      .def("text", &identification_text, "For a person at a terminal.")
      .def("html", &html, "A page with plots.")
      .def(
          "robot_text",
          [](const Identification& id, const std::string& path) { return robot_text_for(path, id.robot); },
          py::arg("path"), "The identified robot, URDF for a path that ends in .urdf.");
  module.def("identify", &identify_logs, py::arg("logs"), py::arg("robot"), py::arg("output"),
             py::arg("method"), py::arg("keep_all"), py::arg("force"), py::arg("threads"),
             py::arg("progress"), "Identifies a robot's parameters from logs of healthy runs.");
}

}  // namespace faultline
