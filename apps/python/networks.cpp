// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "apps/python/bindings.hpp"
#include "apps/python/log_handle.hpp"
#include "apps/work/file_use.hpp"
#include "lib/classify/episode_features.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/diagnose/decide_episode.hpp"
#include "lib/diagnose/monitor/monitor.hpp"
#include "lib/fault/fault_kind.hpp"
#include "lib/log/prefetch.hpp"

namespace faultline {
namespace {

namespace py = pybind11;
using Eigen::MatrixXd;
using Json = nlohmann::ordered_json;
/// A row per sample, as in NumPy.
using Rows = py::array_t<double, py::array::c_style>;

/// A matrix that is an input or output of a network: its columns, with a row per sample.
struct NetworkPort {
  std::string name;                    ///< such as "tau"
  std::vector<std::string> columns{};  ///< such as "tau1"
  std::vector<std::string> units{};    ///< of the columns; "1" for a number without one
  std::string what{};                  ///< description for the user
};

/// The interface of one of a model's networks: in SI units, with the scaling of its numbers inside.
struct NetworkLayout {
  std::string name;  ///< such as "sample_mlp"
  std::string what;  ///< description for the user
  std::vector<NetworkPort> inputs{};
  NetworkPort output{};
};

/// Returns a port with a column per joint, with the unit for revolute or prismatic joints.
NetworkPort of_joints(const Model& model, const std::string& name, const char* turning, const char* sliding,
                      std::string what) {
  NetworkPort port{.name = name, .what = std::move(what)};
  const auto& geometry = model.robot.chain.geometry;
  for (int j = 0; j < std::ssize(geometry); ++j) {
    port.columns.push_back(name + std::to_string(Joint::at(j).number()));
    port.units.emplace_back(geometry[j].kind == AxisKind::revolute ? turning : sliding);
  }
  return port;
}

NetworkPort of_classes(const std::string& name, const std::vector<FaultLabel>& classes, std::string what) {
  NetworkPort port{.name = name, .what = std::move(what)};
  for (const FaultLabel& label : classes) port.columns.push_back(label_text(label));
  port.units.assign(port.columns.size(), "1");
  return port;
}

NetworkPort both(NetworkPort first, const NetworkPort& second, const std::string& name, std::string what) {
  first.name = name;
  first.what = std::move(what);
  first.columns.insert(first.columns.end(), second.columns.begin(), second.columns.end());
  first.units.insert(first.units.end(), second.units.begin(), second.units.end());
  return first;
}

NetworkLayout residual_layout(const Model& model) {
  const ResidualGenerator& generator = model.residual;
  NetworkLayout layout{.name = "residual_mlp", .what = "One-step prediction of the healthy motion"};
  layout.inputs = {of_joints(model, "q", "rad", "m", "joint positions"),
                   of_joints(model, "dq", "rad/s", "m/s", "joint velocities"),
                   of_joints(model, "tau", "N m", "N", "joint torques or forces at the same row")};
  if (generator.uses_mean_torque)
    layout.inputs.push_back(
        of_joints(model, "mean_tau", "N m", "N", "joint torques or forces, mean over the step"));
  if (generator.kind == ResidualKind::mlp && generator.target == PredictedQuantity::state) {
    layout.output = both(of_joints(model, "q", "rad", "m", ""), of_joints(model, "dq", "rad/s", "m/s", ""),
                         "next_state", "positions and velocities step_s later");
    return layout;
  }
  layout.output =
      both(of_joints(model, "change_q", "rad", "m", ""), of_joints(model, "change_dq", "rad/s", "m/s", ""),
           "change",
           generator.kind == ResidualKind::hybrid
               ? "change of positions and velocities over step_s beyond what the identified robot predicts"
               : "change of positions and velocities over step_s");
  return layout;
}

const char* unit_in_features(FeatureRole role) {
  switch (role) {
    case FeatureRole::behind:
      return "-ln(1 + nats)";
    case FeatureRole::strength:
      return "ln(1 + nats)";
    case FeatureRole::duration:
      return "ln(s)";
    case FeatureRole::residual:
      return "ln(healthy rms)";
    case FeatureRole::size:
      return "1";
  }
  return "1";
}

NetworkLayout evidence_layout(const Model& model, const std::string& name, std::string what,
                              std::string output) {
  NetworkLayout layout{.name = name, .what = std::move(what)};
  NetworkPort features{.name = "features", .what = "evidence of one episode, as the diagnosis collects it"};
  for (const EpisodeFeature& feature : episode_feature_list(model.labels, model.robot.joints())) {
    features.columns.push_back(name_of(feature));
    features.units.emplace_back(unit_in_features(feature.role));
  }
  const int known = static_cast<int>(features.columns.size()), taken = model.episode_classifier.scaler.size();
  if (taken != known)
    throw Error(ErrorCode::input, model.name,
                fmt::format("its evidence classifiers take {} features, but this program collects {}; "
                            "learn the model again",
                            taken, known));
  layout.inputs.push_back(std::move(features));
  layout.output = of_classes("classes", model.episode_classifier.labels, std::move(output));
  return layout;
}

NetworkLayout sample_layout(const Model& model, const std::string& name, std::string what,
                            std::string output) {
  NetworkLayout layout{.name = name, .what = std::move(what)};
  if (model.samples.classifier.features == SampleFeatures::velocity) {
    layout.inputs = {of_joints(model, "velocity_residual", "healthy rms", "healthy rms",
                               "measured minus predicted velocity in units of the healthy rms")};
  } else {
    layout.inputs = {of_joints(model, "torque_residual", "N m", "N",
                               "torque that the velocity residual stands for: M(q) r / dt"),
                     of_joints(model, "torque", "N m", "N", "logged torque, mean over the step")};
  }
  layout.output = of_classes("classes", model.samples.classifier.classes, std::move(output));
  return layout;
}

/// Returns residuals with the data that the sample classifiers use.
Residuals residuals_from(const Model& model, const std::vector<MatrixXd>& inputs) {
  Residuals out;
  out.row.resize(static_cast<std::size_t>(inputs.front().cols()));
  std::iota(out.row.begin(), out.row.end(), 0);
  out.time = Eigen::VectorXd::Zero(inputs.front().cols());
  out.velocity = inputs.front();
  if (model.samples.classifier.features == SampleFeatures::velocity) return out;
  out.torque = inputs[0];
  out.tau = inputs[1];
  out.ratio = ratio_to_torque(out.torque, out.tau, model.residual.healthy.torque_rms);
  return out;
}

Transitions transitions_from(const ResidualGenerator& generator, const std::vector<MatrixXd>& inputs) {
  Transitions out;
  out.q = inputs[0];
  out.dq = inputs[1];
  out.tau = inputs[2];
  if (generator.uses_mean_torque) out.mean_tau = inputs[3];
  out.row.resize(static_cast<std::size_t>(out.q.cols()));
  return out;
}

/// Returns all networks of the model; none if it has no mechanics. Throws Error(input) if the evidence
/// classifiers were trained on other features than this program collects.
std::vector<NetworkLayout> network_layouts(const Model& model) {
  constexpr const char* kProbability = "probability of each class";
  constexpr const char* kNearOne = "near 1 for the right class, near 0 for the others";
  std::vector<NetworkLayout> all;
  if (!model.has_mechanics()) return all;
  if (model.residual.kind != ResidualKind::physics) all.push_back(residual_layout(model));
  if (model.episode_classifier.trained()) {
    all.push_back(
        evidence_layout(model, "evidence_mlp", "Evidence classifier: the MLP on an episode", kProbability));
    all.push_back(
        evidence_layout(model, "evidence_rbfn", "Evidence classifier: the RBFN on an episode", kNearOne));
  }
  const bool softmax = model.samples.classifier.mlp.output == OutputKind::softmax;
  all.push_back(sample_layout(model, "sample_mlp", "Sample classifier: the MLP on one sample",
                              softmax ? kProbability : kNearOne));
  all.push_back(sample_layout(model, "sample_rbfn", "Sample classifier: the RBFN on one sample", kNearOne));
  return all;
}

/// Runs the named network; returns outputs x samples. The inputs are in the order of the layout, each columns
/// x samples.
MatrixXd run_network(const Model& model, const std::string& network, const std::vector<MatrixXd>& inputs) {
  if (network == "residual_mlp")
    return network_outputs(model.residual, transitions_from(model.residual, inputs));
  if (network.starts_with("evidence")) {
    const EpisodeClassifier& classifier = model.episode_classifier;
    const MatrixXd scaled = classifier.scaler.apply(inputs.front());
    return network == "evidence_mlp" ? forward(classifier.mlp, scaled) : forward(classifier.rbfn, scaled);
  }
  const SampleOutputs outputs = classify_samples(model.samples.classifier, residuals_from(model, inputs));
  return network == "sample_mlp" ? outputs.mlp : outputs.rbfn;
}

Json port_json(const NetworkPort& port) {
  return {{"name", port.name}, {"what", port.what}, {"columns", port.columns}, {"units", port.units}};
}

std::string layouts_json(const LoadedModel& loaded) {
  Json all = Json::array();
  for (const NetworkLayout& layout : network_layouts(loaded.model)) {
    Json inputs = Json::array();
    for (const NetworkPort& port : layout.inputs) inputs.push_back(port_json(port));
    all.push_back({{"name", layout.name},
                   {"what", layout.what},
                   {"inputs", std::move(inputs)},
                   {"output", port_json(layout.output)}});
  }
  return all.dump();
}

/// Returns the layout of the named network. Throws Error(usage).
NetworkLayout layout_named(const Model& model, const std::string& network) {
  std::string names;
  for (NetworkLayout& layout : network_layouts(model)) {
    if (layout.name == network) return std::move(layout);
    names += (names.empty() ? "" : ", ") + layout.name;
  }
  throw Error(ErrorCode::usage, "network",
              "\"" + network +
                  "\" is not a network of this model; its networks are: " + (names.empty() ? "none" : names));
}

/// Returns columns x samples. Throws Error(usage) for another shape than that of the port.
MatrixXd matrix_of(const NetworkPort& port, const Rows& rows) {
  const auto columns = static_cast<py::ssize_t>(port.columns.size());
  if (rows.ndim() != 2 || rows.shape(1) != columns)
    throw Error(ErrorCode::usage, port.name,
                fmt::format("is not a matrix of {} columns with one row per sample: {}", columns,
                            fmt::join(port.columns, ", ")));
  return Eigen::Map<const MatrixXd>(rows.data(), columns, rows.shape(0));
}

Rows rows_of(const MatrixXd& matrix) {
  std::vector<double> values(matrix.data(), matrix.data() + matrix.size());
  return owned_array(std::move(values)).reshape({matrix.cols(), matrix.rows()});
}

Rows outputs_of(const LoadedModel& loaded, const std::string& network, const std::vector<Rows>& arrays) {
  const NetworkLayout layout = layout_named(loaded.model, network);
  if (arrays.size() != layout.inputs.size())
    throw Error(ErrorCode::usage, network, fmt::format("takes {} inputs", layout.inputs.size()));
  std::vector<MatrixXd> inputs;
  for (std::size_t i = 0; i < arrays.size(); ++i) inputs.push_back(matrix_of(layout.inputs[i], arrays[i]));
  for (const MatrixXd& input : inputs)
    if (input.cols() != inputs.front().cols())
      throw Error(ErrorCode::usage, network, "takes inputs of the same number of rows");
  MatrixXd outputs;
  {
    const py::gil_scoped_release others_run;
    outputs = run_network(loaded.model, network, inputs);
  }
  return rows_of(outputs);
}

/// Appends the columns of each part.
void append(std::vector<MatrixXd>& whole, const std::vector<const MatrixXd*>& parts) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    MatrixXd& to = whole[i];
    const Eigen::Index before = to.cols();
    to.conservativeResize(parts[i]->rows(), before + parts[i]->cols());
    to.rightCols(parts[i]->cols()) = *parts[i];
  }
}

std::vector<MatrixXd> residual_inputs(LogSource& log, const Model& model) {
  std::vector<MatrixXd> whole(model.residual.uses_mean_torque ? 4 : 3, MatrixXd(model.robot.joints(), 0));
  ResidualState state;
  for (Log segment; log.next(segment);) {
    if (segment.tau.empty()) continue;
    const Transitions pairs = log_transitions(model.residual, segment, state);
    append(whole, model.residual.uses_mean_torque
                      ? std::vector{&pairs.q, &pairs.dq, &pairs.tau, &pairs.mean_tau}
                      : std::vector{&pairs.q, &pairs.dq, &pairs.tau});
  }
  return whole;
}

std::vector<MatrixXd> sample_inputs(LogSource& log, const Model& model) {
  const bool velocity = model.samples.classifier.features == SampleFeatures::velocity;
  std::vector<MatrixXd> whole(velocity ? 1 : 2, MatrixXd(model.robot.joints(), 0));
  ResidualState state;
  for (Log segment; log.next(segment);) {
    const Residuals residuals = compute_residuals(model.residual, segment, state);
    if (residuals.count() == 0) continue;
    append(whole,
           velocity ? std::vector{&residuals.velocity} : std::vector{&residuals.torque, &residuals.tau});
  }
  return whole;
}

std::vector<MatrixXd> evidence_inputs(LogSource& log, const Model& model, std::size_t features) {
  const std::vector<MonitoredEpisode> episodes = monitor(log, model).episodes;
  MatrixXd whole(features, episodes.size());
  for (std::size_t i = 0; i < episodes.size(); ++i) {
    const std::vector<double> one = describe_episode(episodes[i], model).episode.features;
    whole.col(static_cast<Eigen::Index>(i)) = Eigen::Map<const Eigen::VectorXd>(one.data(), whole.rows());
  }
  return {whole};
}

/// Returns the inputs by name.
py::dict inputs_in(const std::shared_ptr<LoadedModel>& loaded, const std::string& network,
                   const std::shared_ptr<LogHandle>& log, const py::object& progress) {
  const Model& model = loaded->model;
  const NetworkLayout layout = layout_named(model, network);
  const std::vector<MatrixXd> inputs = watched(progress, [&](ProgressRelay& watch) {
    const auto source = prefetched(log->open(model.robot, watch, true));
    if (network.starts_with("residual")) return residual_inputs(*source, model);
    if (network.starts_with("sample")) return sample_inputs(*source, model);
    return evidence_inputs(*source, model, layout.inputs.front().columns.size());
  });
  py::dict arrays;
  for (std::size_t i = 0; i < inputs.size(); ++i) arrays[layout.inputs[i].name.c_str()] = rows_of(inputs[i]);
  return arrays;
}

/// Writes files by name into the folder, which is created; all are complete before the first is renamed.
std::vector<std::string> write_networks(const LoadedModel& loaded, const std::string& folder,
                                        const std::vector<std::pair<std::string, py::bytes>>& files) {
  std::vector<std::pair<std::string, std::string>> contents;
  for (const auto& [name, bytes] : files)
    contents.emplace_back((std::filesystem::path(folder) / name).string(), std::string(bytes));
  const py::gil_scoped_release others_run;
  FileUse use;
  if (!loaded.paths.model.empty()) use.reads(loaded.paths);
  for (const auto& [path, bytes] : contents) use.writes("the network " + path + ",", path);
  use.claim();
  make_folder(folder);
  std::vector<std::unique_ptr<AtomicFile>> open;
  std::vector<std::string> paths;
  for (const auto& [path, bytes] : contents) {
    paths.push_back(path);
    open.push_back(std::make_unique<AtomicFile>(path));
    open.back()->write(bytes);
  }
  for (const auto& file : open) file->commit();
  return paths;
}

}  // namespace

void bind_networks(py::module_& module) {
  module.def("network_layouts", &layouts_json, py::arg("model"),
             "Names, inputs and outputs of the networks of a model, as JSON.");
  module.def("network_outputs", &outputs_of, py::arg("model"), py::arg("network"), py::arg("inputs"),
             "The output of a network for its inputs.");
  module.def("network_inputs", &inputs_in, py::arg("model"), py::arg("network"), py::arg("log"),
             py::arg("progress"), "The inputs of a network for a log, by name.");
  module.def("write_networks", &write_networks, py::arg("model"), py::arg("folder"), py::arg("files"),
             "Writes files into a folder, all or none of each.");
}

}  // namespace faultline
