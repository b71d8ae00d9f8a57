// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <memory>

#include "apps/inspection/inspection.hpp"
#include "apps/python/bindings.hpp"
#include "apps/python/log_handle.hpp"

namespace faultline {
namespace {

namespace py = pybind11;

std::shared_ptr<Inspection> inspect(const std::shared_ptr<LogHandle>& log, const std::string& robot_name,
                                    const py::object& progress) {
  return watched(progress, [&](ProgressRelay& watch) {
    const std::optional<Robot> robot = robot_named(robot_name);
    return std::make_shared<Inspection>(
        inspect_columns(log->open_columns(robot ? robot->log.recording : RecordingChoice{}), robot,
                        watch.progress(), log->parts().run));
  });
}

}  // namespace

void bind_inspect(py::module_& module) {
  py::class_<Inspection, std::shared_ptr<Inspection>>(module, "Inspection", "What a log holds.")
      .def(
          "json", [](const Inspection& seen) { return inspections_json({seen}); },
          "Schema faultline/inspection/1, of this one log.")
      .def(
          "text", [](const Inspection& seen, bool color) { return inspection_text(seen, color); },
          py::arg("color"), "For a person at a terminal.")
      .def(
          "html", [](const Inspection& seen) { return inspection_page({seen}); },
          "A page with pictures of all channels.");
  module.def("inspect", &inspect, py::arg("log"), py::arg("robot"), py::arg("progress"),
             "Reports what a log contains and what is wrong with it.");
}

}  // namespace faultline
