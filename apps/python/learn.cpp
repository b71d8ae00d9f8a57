// SPDX-License-Identifier: MIT
#include "lib/learn/learn.hpp"

#include <pybind11/stl.h>

#include <cmath>
#include <map>
#include <utility>

#include "apps/python/bindings.hpp"
#include "apps/python/log_handle.hpp"
#include "apps/work/file_use.hpp"
#include "apps/work/learned_text.hpp"
#include "apps/work/learning.hpp"
#include "lib/core/error.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

namespace py = pybind11;

using Logs = std::vector<std::shared_ptr<LogHandle>>;
/// By name of a log: fault, joint, onset_s.
using GivenLabels = std::map<std::string, std::tuple<std::string, int, double>>;

struct LearnCall : ModelPaths {
  std::string robot, label_file;
  GivenLabels labels;
  LearnOptions options;
};

struct LearnedModel {
  ModelPaths paths;
  Learned learned;
  std::optional<CarriedCases> carried;
};

std::vector<LogLabel> labels_of(const LearnCall& call) {
  std::vector<LogLabel> labels;
  if (!call.label_file.empty()) labels = read_labels(call.label_file);
  for (const auto& [name, label] : call.labels) {
    const auto& [fault, joint, onset_s] = label;
    labels.push_back({name, {fault_kind_from(fault), Joint::numbered(joint)}, onset_s});
  }
  return labels;
}

void claim_files(const Logs& logs, const LearnCall& call) {
  FileUse files;
  for (const auto& log : logs) files.reads("the log", log->files());
  files.reads("the robot file", call.robot).reads("the labels", call.label_file);
  if (!call.model.empty()) files.writes("output", call.model).writes_case_base("cases", call.case_base());
  files.claim();
}

std::shared_ptr<LearnedModel> learned_from(const Logs& logs, const LearnCall& call, ProgressRelay& watch) {
  claim_files(logs, call);
  const Robot robot = load_robot_file(call.robot);
  const std::vector<LogLabel> labels = labels_of(call);
  OpenLogs open;
  for (const auto& log : logs) open.add(log->name(), log->open(robot, watch, false), labels, robot);
  open.require_healthy();
  if (!call.model.empty()) check_writable(call, robot);
  auto out = std::make_shared<LearnedModel>();
  out->paths = call;
  out->learned = learn(open.healthy, open.labelled, robot, call.options, watch.progress());
  if (!call.model.empty()) out->carried = write_model(out->learned.model, out->learned.cases, call);
  return out;
}

std::shared_ptr<LearnedModel> learn_logs(const Logs& logs, const std::string& robot,
                                         const std::string& output, const std::string& cases,
                                         const std::string& label_file, const GivenLabels& labels,
                                         const py::dict& options, const py::object& progress) {
  if (logs.empty()) throw Error(ErrorCode::usage, "learn", "was given no log");
  LearnCall call{{output, cases}, robot, label_file, labels, {}};
  LearnOptions& chosen = call.options;
  chosen.runs_per_label = options["runs_per_label"].cast<int>();
  chosen.alarms_per_hour = options["alarms_per_hour"].cast<double>();
  chosen.identify.keep_all = options["keep_all"].cast<bool>();
  chosen.keep_doubtful = options["force"].cast<bool>();
  chosen.seed = options["seed"].cast<std::uint64_t>();
  chosen.threads = chosen.identify.threads = options["threads"].cast<int>();
  return watched(progress, [&](ProgressRelay& watch) { return learned_from(logs, call, watch); });
}

/// Returns the model as read from its file: converted to text and back.
std::shared_ptr<LoadedModel> model_of(const LearnedModel& made) {
  const py::gil_scoped_release others_run;
  return std::make_shared<LoadedModel>(
      LoadedModel{made.paths, model_from_json(model_to_json(made.learned.model), "the learned model"),
                  made.learned.cases});
}

std::string learning_text(const LearnedModel& made) {
  const bool is_written = !made.paths.model.empty();
  return learned_text(made.learned, is_written ? made.paths.model : "not written",
                      is_written ? made.paths.case_base() : "not written") +
         carried_text(made.carried);
}

}  // namespace

void bind_learn(py::module_& module) {
  py::class_<LearnedModel, std::shared_ptr<LearnedModel>>(module, "Learned", "What learning found.")
      .def(
          "json", [](const LearnedModel& made) { return learned_json(made.learned, made.carried); },
          "A summary, schema faultline/learning/1.")
      .def("text", &learning_text, "The summary for a person.")
      .def("model", &model_of, "The model with its case base.");
  module.def("learn", &learn_logs, py::arg("logs"), py::arg("robot"), py::arg("output"), py::arg("cases"),
             py::arg("label_file"), py::arg("labels"), py::arg("options"), py::arg("progress"),
             "Learns a model of one robot.");
}

}  // namespace faultline
