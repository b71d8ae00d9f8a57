// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <pybind11/stl.h>

#include "apps/python/bindings.hpp"
#include "apps/python/watched_work.hpp"
#include "apps/work/batching.hpp"

namespace faultline {
namespace {

namespace py = pybind11;

/// The summary as JSON and as text, and the number of logs that were diagnosed now.
using Answer = std::tuple<std::string, std::string, int>;

/// Models with the folder of each, "" for all other logs.
using FolderModels = std::vector<std::pair<std::string, std::shared_ptr<LoadedModel>>>;

Answer run(const std::vector<std::string>& paths, const FolderModels& models, const std::string& folder,
           bool html, bool identify, int threads, const std::string& shard, bool wait,
           const py::object& progress) {
  BatchRequest request;
  std::vector<ModelFiles> loaded;
  for (const auto& [of, model] : models) {
    request.models.push_back({model->paths, of});
    loaded.push_back({model->model, model->cases});
  }
  request.paths = paths;
  request.folder = folder;
  request.options.html = html;
  request.options.identify = identify;
  request.options.threads = threads;
  request.options.wait = wait;
  take_shard(shard, request.options);
  return watched(progress, [&](ProgressRelay& watch) {
    request.options.progress = [&watch](const BatchProgress& at) {
      watch.report(fmt::format("{} of {} logs", at.done, at.logs), static_cast<double>(at.done) / at.logs);
    };
    const BatchResult result = run_batch_on(claimed_logs(request), loaded, request);
    return Answer(to_json(result.summary), to_text(result.summary), result.diagnosed);
  });
}

Answer merge(const std::vector<std::string>& folders, const std::string& into) {
  const py::gil_scoped_release others_run;
  const BatchSummary summary = merge_shards(folders, into, "");
  return {to_json(summary), to_text(summary), 0};
}

}  // namespace

void bind_batch(py::module_& module) {
  module.def("batch", &run, py::arg("paths"), py::arg("models"), py::arg("folder"), py::arg("html"),
             py::arg("identify"), py::arg("threads"), py::arg("shard"), py::arg("wait"), py::arg("progress"),
             "Diagnoses all logs of folders.");
  module.def("merge_batches", &merge, py::arg("folders"), py::arg("into"), "Puts shards together.");
}

}  // namespace faultline
