// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <nlohmann/json.hpp>

#include "apps/python/bindings.hpp"
#include "apps/python/watched_work.hpp"
#include "apps/work/simulation.hpp"

namespace faultline {
namespace {

namespace py = pybind11;

std::string simulate_spec(const std::string& spec, const std::string& folder,
                          std::optional<std::uint64_t> seed, const py::object& progress) {
  return watched(progress, [&](ProgressRelay& watch) {
    return simulate_into({spec, folder, seed}, watch.progress()).dump(2) + "\n";
  });
}

std::string reproduce_paper(const std::string& folder, bool quick, std::optional<int> seeds,
                            std::uint64_t seed, int threads, const py::object& progress) {
  ReproduceOptions options;
  options.quick = quick;
  options.seed = seed;
  options.threads = threads;
  if (quick) options.seeds = 1;
  if (seeds) options.seeds = *seeds;
  return watched(
      progress, [&](ProgressRelay& watch) { return reproduce_into(folder, options, watch.progress()).json; });
}

}  // namespace

void bind_simulate(py::module_& module) {
  module.def("simulate", &simulate_spec, py::arg("spec"), py::arg("folder"), py::arg("seed"),
             py::arg("progress"), "Simulates the runs of a spec file.");
  module.def("reproduce", &reproduce_paper, py::arg("folder"), py::arg("quick"), py::arg("seeds"),
             py::arg("seed"), py::arg("threads"), py::arg("progress"), "Rebuilds the paper's results.");
}

}  // namespace faultline
