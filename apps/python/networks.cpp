// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/python/bindings.hpp"
#include "apps/python/log_handle.hpp"
#include "apps/python/network_layout.hpp"
#include "apps/work/file_use.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/diagnose/decide_episode.hpp"
#include "lib/diagnose/monitor/monitor.hpp"
#include "lib/log/prefetch.hpp"

namespace faultline {
namespace {

namespace py = pybind11;
using Eigen::MatrixXd;
using Json = nlohmann::ordered_json;
/// A row per sample, as in NumPy.
using Rows = py::array_t<double, py::array::c_style>;

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

py::list inputs_in(const std::shared_ptr<LoadedModel>& loaded, const std::string& network,
                   const std::shared_ptr<LogHandle>& log, const py::object& progress) {
  const Model& model = loaded->model;
  const NetworkLayout layout = layout_named(model, network);
  const std::vector<MatrixXd> inputs = watched(progress, [&](ProgressRelay& watch) {
    const auto source = prefetched(log->open(model.robot, watch, true));
    if (network.starts_with("residual")) return residual_inputs(*source, model);
    if (network.starts_with("sample")) return sample_inputs(*source, model);
    return evidence_inputs(*source, model, layout.inputs.front().columns.size());
  });
  py::list arrays;
  for (const MatrixXd& input : inputs) arrays.append(rows_of(input));
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
             py::arg("progress"), "The inputs of a network for a log.");
  module.def("write_networks", &write_networks, py::arg("model"), py::arg("folder"), py::arg("files"),
             "Writes files into a folder, all or none of each.");
}

}  // namespace faultline
