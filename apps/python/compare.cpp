// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>

#include "apps/python/bindings.hpp"
#include "apps/python/log_handle.hpp"
#include "apps/work/comparison.hpp"
#include "lib/log/derived_velocity.hpp"
#include "lib/report/html/comparison/comparison_page.hpp"

namespace faultline {
namespace {

namespace py = pybind11;

/// `loaded` is null where a model is given by its path, or none is.
std::shared_ptr<ComparedLogs> compare(const std::shared_ptr<LogHandle>& first,
                                      const std::shared_ptr<LogHandle>& second,
                                      const std::shared_ptr<LoadedModel>& loaded, const std::string& path,
                                      const std::string& align, const py::object& progress) {
  const AlignmentKind kind = named("align", align, kAlignmentKinds);
  return watched(progress, [&](ProgressRelay& watch) {
    std::optional<Model> own;
    if (!path.empty()) own = load_model(path);
    const Model* const model = loaded ? &loaded->model : own ? &*own : nullptr;
    const auto opened = [&](const LogHandle& log) {
      return with_velocity(model ? log.open(model->robot, watch, true)
                                 : log.open_channels(nullptr, false, watch));
    };
    const auto one = opened(*first), other = opened(*second);
    return std::make_shared<ComparedLogs>(compare_logs(*one, *other, model, kind));
  });
}

}  // namespace

void bind_compare(py::module_& module) {
  py::class_<ComparedLogs, std::shared_ptr<ComparedLogs>>(module, "Comparison", "Two runs, compared.")
      .def_property_readonly(
          "same", [](const ComparedLogs& made) { return made.comparison.same(); },
          "Whether the runs are the same within noise.")
      .def(
          "json", [](const ComparedLogs& made) { return to_json(made.comparison, made.turns); },
          "Schema faultline/comparison/1.")
      .def(
          "text", [](const ComparedLogs& made) { return to_text(made.comparison, made.turns); },
          "For a person at a terminal.")
      .def(
          "html",
          [](const ComparedLogs& made) { return render_comparison_html(made.comparison, made.turns); },
          "A page with pictures of all signals.");
  module.def("compare", &compare, py::arg("first"), py::arg("second"), py::arg("model"),
             py::arg("model_path"), py::arg("align"), py::arg("progress"),
             "Compares two runs signal by signal.");
}

}  // namespace faultline
