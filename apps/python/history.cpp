// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <string>
#include <tuple>
#include <vector>

#include "apps/python/bindings.hpp"
#include "apps/work/history_results.hpp"
#include "lib/history/history_file.hpp"
#include "lib/history/robot_history.hpp"

namespace faultline {
namespace {

namespace py = pybind11;

/// The robots of a history, and what became of the results that were added.
struct ReadHistory {
  std::vector<RobotHistory> robots;
  HistoryGrowth growth;
};

ReadHistory read(const std::vector<std::string>& results, const std::string& db,
                 const std::vector<std::string>& robots) {
  const py::gil_scoped_release others_run;
  ReadHistory out;
  if (!results.empty()) out.growth = add_to_history(db, history_results(results));
  out.robots = robot_histories(read_history(db), robots);
  return out;
}

}  // namespace

void bind_history(py::module_& module) {
  py::class_<ReadHistory>(module, "History", "The robots of a history file.")
      .def_property_readonly(
          "growth",
          [](const ReadHistory& made) {
            return std::tuple(made.growth.added, made.growth.replaced, made.growth.unchanged);
          },
          "Results added, replaced, and known before.")
      .def(
          "json", [](const ReadHistory& made) { return history_json(made.robots); },
          "Schema faultline/history/1.")
      .def(
          "text", [](const ReadHistory& made) { return to_text(made.robots); }, "For a person at a terminal.")
      .def(
          "html", [](const ReadHistory& made) { return history_page(made.robots); },
          "A page with a line a robot.");
  module.def("history", &read, py::arg("results"), py::arg("db"), py::arg("robots"),
             "Adds results to a history file and reads it.");
}

}  // namespace faultline
