// SPDX-License-Identifier: MIT
#include "lib/diagnose/diagnosis.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <string>

#include "apps/python/bindings.hpp"
#include "apps/python/log_handle.hpp"
#include "apps/work/diagnosis_recording.hpp"
#include "apps/work/stop_moment.hpp"
#include "lib/core/error.hpp"
#include "lib/diagnose/curves/run_curves.hpp"
#include "lib/diagnose/diagnose.hpp"
#include "lib/fault/fault_kind.hpp"
#include "lib/log/prefetch.hpp"
#include "lib/report/html/html_report.hpp"
#include "lib/report/text.hpp"

namespace faultline {
namespace {

namespace py = pybind11;

/// A diagnosis with the data for further passes over the log.
struct MadeDiagnosis {
  SharedModel model;
  std::shared_ptr<const LogHandle> log;
  DiagnoseOptions options;
  Diagnosis diagnosis;

  /// Reads the log again. Throws Error(input) when it has changed since the diagnosis.
  template <typename Look>
  auto look_again(const py::object& progress, Look look) const {
    return watched(progress, [&](ProgressRelay& watch) {
      const auto source = prefetched(log->open(model->model.robot, watch, true));
      auto seen = look(*source);
      if (source->identity().sha256 != diagnosis.log.sha256)
        throw Error(ErrorCode::input, log->name(), "was changed since it was diagnosed; diagnose it again");
      return seen;
    });
  }
};

std::shared_ptr<MadeDiagnosis> make_diagnosis(const std::shared_ptr<LogHandle>& log,
                                              const std::shared_ptr<LoadedModel>& model,
                                              const std::string& classify, const std::string& criterion,
                                              int g, const std::string& moment, const std::string& stop,
                                              const py::object& progress) {
  DiagnoseOptions options;
  options.mode = named("classify", classify, kClassifyModes);
  options.criterion = named("criterion", criterion, kCriterionKinds);
  options.g = g;
  if (g < 0) throw Error(ErrorCode::usage, "g", "must not be negative");
  Diagnosis diagnosis = watched(progress, [&](ProgressRelay& watch) {
    const Robot& robot = model->model.robot;
    const StopLog columns{log->name(), log->parts().run,
                          [&] { return log->open_columns(robot.log.recording); }};
    options.stop = stop_question(columns, robot, moment, stop);
    const auto source = prefetched(log->open(robot, watch, true));
    return diagnose(*source, model->model, model->cases, options);
  });
  return std::make_shared<MadeDiagnosis>(MadeDiagnosis{model, log, options, std::move(diagnosis)});
}

std::string render(const MadeDiagnosis& made, const std::string& format, const py::object& progress) {
  const ReportFormat& chosen = report_format(format);
  if (chosen.second_pass)
    return made.look_again(progress, [&](LogSource& source) {
      return chosen.render(report_source(source, made.model->model, made.diagnosis, made.options));
    });
  const py::gil_scoped_release others_run;
  return chosen.render({made.diagnosis, {}});
}

void record(const MadeDiagnosis& made, const std::string& path, const py::object& progress) {
  if (path == "-")
    throw Error(ErrorCode::usage, "mcap", "cannot be standard output; give the name of a file");
  FileUse().reads("the log", made.log->files()).reads(made.model->paths).writes("mcap", path).claim();
  made.look_again(progress, [&](LogSource& source) {
    write_recording(path, source, made.model->model, made.diagnosis);
    return true;
  });
}

std::string text(const MadeDiagnosis& made, int width, bool unicode, bool color) {
  TimelineOptions options;
  options.width = width;
  options.unicode = unicode;
  options.color = color;
  return render_text(made.diagnosis, options);
}

py::array_t<double> times(const CurveWindow& window, std::size_t count) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = window.time_s(i, count);
  return owned_array(std::move(values));
}

void put(py::dict& signals, const std::string& name, const std::vector<float>& values) {
  if (!values.empty()) signals[name.c_str()] = owned_array(std::vector<double>(values.begin(), values.end()));
}

py::dict window_arrays(const CurveWindow& window) {
  py::dict out;
  out["fault_id"] = window.fault_id;
  out["start_s"] = window.start_s;
  out["end_s"] = window.end_s;
  const auto bins = static_cast<std::size_t>(window.bins);
  out["t"] = times(window, 2 * bins);
  out["t_residual"] = times(window, bins);
  for (int j = 0; j < std::ssize(window.joints); ++j) {
    const JointCurves& joint = window.joints[j];
    const std::string number = std::to_string(Joint::at(j).number());
    put(out, "q" + number, joint.q.values);
    put(out, "q" + number + "_predicted", joint.q_predicted.values);
    put(out, "dq" + number, joint.dq.values);
    put(out, "dq" + number + "_predicted", joint.dq_predicted.values);
    put(out, "tau" + number, joint.tau.values);
    put(out, "tau" + number + "_required", joint.tau_required.values);
    put(out, "residual" + number, joint.residual);
  }
  for (const NetworkCurves& network : window.networks) {
    put(out, "mlp " + label_text(network.label), network.mlp.values);
    put(out, "rbfn " + label_text(network.label), network.rbfn.values);
  }
  return out;
}

/// Returns {"whole": window, "faults": [window, ...], "healthy_residual": [...], "by_reference": bool,
/// "alarm_ratio": x}; a window is {"fault_id", "start_s", "end_s", "t", "t_residual", "q1", "q1_predicted",
/// ..., "residual1", ...} with an array per signal. Signals that the log lacks are omitted.
py::dict curve_arrays(const RunCurves& curves) {
  py::dict out;
  out["whole"] = curves.empty() ? py::dict() : window_arrays(curves.whole);
  py::list faults;
  for (const CurveWindow& window : curves.details) faults.append(window_arrays(window));
  out["faults"] = faults;
  out["healthy_residual"] = curves.healthy_residual;
  out["by_reference"] = curves.by_reference;
  out["alarm_ratio"] = curves.alarm_ratio;
  return out;
}

py::dict curves(const MadeDiagnosis& made, int bins, const py::object& progress) {
  RunCurvesOptions options;
  if (bins < 1) throw Error(ErrorCode::usage, "bins", "must be at least 1");
  options.whole_bins = bins;
  options.detail_bins = bins;
  options.all_details = std::max(options.all_details, bins * options.most_details);
  return curve_arrays(made.look_again(progress, [&](LogSource& source) {
    return run_curves(source, made.model->model, made.diagnosis, options);
  }));
}

}  // namespace

void bind_diagnosis(py::module_& module) {
  py::class_<MadeDiagnosis, std::shared_ptr<MadeDiagnosis>>(module, "Diagnosis",
                                                            "The result of diagnosing a log.")
      .def("render", &render, py::arg("format"), py::arg("progress"),
           "A report: json, csv, html, md or junit. The page reads the log once more.")
      .def("record", &record, py::arg("path"), py::arg("progress"),
           "Writes the log with what was found as MCAP, by a second pass over the log.")
      .def("text", &text, py::arg("width"), py::arg("unicode"), py::arg("color"), "The report of a terminal.")
      .def(
          "sentence", [](const MadeDiagnosis& made) { return verdict_sentence(made.diagnosis); },
          "The verdict in one sentence.")
      .def("curves", &curves, py::arg("bins"), py::arg("progress"),
           "The course of the run as arrays, by a second pass over the log.");
  module.def("diagnose", &make_diagnosis, py::arg("log"), py::arg("model"), py::arg("classify"),
             py::arg("criterion"), py::arg("g"), py::arg("at"), py::arg("stop"), py::arg("progress"),
             "Finds the faults in one log.");
}

}  // namespace faultline
