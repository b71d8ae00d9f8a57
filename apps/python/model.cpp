// SPDX-License-Identifier: MIT
#include "lib/model/model.hpp"

#include "apps/python/bindings.hpp"
#include "apps/python/watched_work.hpp"
#include "apps/work/learning.hpp"
#include "lib/model/model_files.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

namespace py = pybind11;

std::shared_ptr<LoadedModel> load(const std::string& path, const std::string& cases) {
  const py::gil_scoped_release others_run;
  const ModelPaths paths{path, cases};
  ModelFiles files = load_model_files(path, paths.case_base());
  return std::make_shared<LoadedModel>(LoadedModel{paths, std::move(files.model), std::move(files.cases)});
}

void save(const LoadedModel& loaded, const std::string& path, const std::string& cases) {
  const py::gil_scoped_release others_run;
  const ModelPaths paths{path, cases};
  check_writable(paths, loaded.model.robot);
  CaseBase base = loaded.cases;
  write_model(loaded.model, base, paths);
}

/// Returns whether the model was edited; one that was not stays as it is.
bool sign(const std::string& path, const std::string& why) {
  const py::gil_scoped_release others_run;
  return sign_model(path, why);
}

}  // namespace

void bind_model(py::module_& module) {
  py::class_<LoadedModel, std::shared_ptr<LoadedModel>>(module, "Model", "A model with its case base.")
      .def(py::init(&load), py::arg("path"), py::arg("cases"))
      .def_property_readonly(
          "path", [](const LoadedModel& m) { return m.paths.model; }, "Where it was read.")
      .def_property_readonly(
          "cases", [](const LoadedModel& m) { return m.paths.model.empty() ? "" : m.paths.case_base(); },
          "The file of its case base.")
      .def_property_readonly(
          "own_cases", [](const LoadedModel& m) { return m.paths.cases; },
          "The same where it was named, \"\" for the one beside the model.")
      .def_property_readonly(
          "cases_sha256", [](const LoadedModel& m) { return m.cases.sha256(); },
          "Of the content of its case base.")
      .def_property_readonly(
          "name", [](const LoadedModel& m) { return m.model.name; }, "The robot's name.")
      .def_property_readonly(
          "sha256", [](const LoadedModel& m) { return m.model.sha256; }, "Of the model file.")
      .def_property_readonly(
          "joints", [](const LoadedModel& m) { return m.model.robot.joints(); }, "Axes of the robot.")
      .def_property_readonly(
          "sample_period_s", [](const LoadedModel& m) { return m.model.sample_period_s; },
          "Of the logs that it was learned from.")
      .def_property_readonly(
          "has_mechanics", [](const LoadedModel& m) { return m.model.has_mechanics(); },
          "False for a model that describes only how joints follow their references.")
      .def(
          "json", [](const LoadedModel& m) { return model_to_json(m.model); }, "The model file's text.")
      .def(
          "robot_text", [](const LoadedModel& m) { return robot_file_text(m.model.robot); },
          "The identified robot as a robot file.")
      .def("save", &save, py::arg("path"), py::arg("cases"), "Writes model and case base.");
  module.def("sign_model", &sign, py::arg("path"), py::arg("why"),
             "Accepts a model that was edited on purpose.");
}

}  // namespace faultline
