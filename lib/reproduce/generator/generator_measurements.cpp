// SPDX-License-Identifier: MIT
#include "lib/reproduce/generator/generator_measurements.hpp"

#include <cmath>
#include <iterator>
#include <limits>
#include <mutex>

#include "lib/core/error.hpp"
#include "lib/core/parallel.hpp"

namespace faultline {
namespace {

template <class Pick>
std::optional<Measured> by_seed(const GeneratorMeasurements& all, int candidate, int controller,
                                const Pick& pick) {
  Measured measured;
  for (int seed = 0; seed < all.seeds; ++seed) {
    const auto& errors = all.errors[all.index(candidate, controller, seed)];
    measured.by_seed.push_back(errors ? pick(*errors) : std::numeric_limits<double>::quiet_NaN());
  }
  if (std::isnan(measured.mean())) return std::nullopt;
  return measured;
}

IdentifiedBench identified_bench(const Experiment& experiment, const GeneratorComparison& comparison) {
  const GeneratorScale& scale = comparison.scale;
  IdentifiedBench out{generator_bench(experiment, scale.test_trajectories),
                      identified_robot(experiment, scale.slow_logs),
                      {}};
  if (comparison.with_fast_logs && experiment.controller != ControllerVariant::held)
    out.identified_at_1khz = identified_robot(experiment, scale.fast_logs);
  return out;
}

}  // namespace

std::size_t GeneratorMeasurements::index(int candidate, int controller, int seed) const {
  return static_cast<std::size_t>((candidate * kControllers + controller) * seeds + seed);
}

std::optional<Measured> GeneratorMeasurements::mse(int candidate, int controller, GeneratorTest test) const {
  return by_seed(*this, candidate, controller,
                 [&](const GeneratorErrors& found) { return found.mse.col(static_cast<int>(test)).mean(); });
}

std::optional<Measured> GeneratorMeasurements::mse(int candidate, int controller, GeneratorTest test,
                                                   int output) const {
  return by_seed(*this, candidate, controller,
                 [&](const GeneratorErrors& found) { return found.mse(output, static_cast<int>(test)); });
}

WorstSamples GeneratorMeasurements::worst(int candidate, int controller) const {
  const auto mean = [&](double WorstSamples::*figure) {
    const auto figures = by_seed(*this, candidate, controller,
                                 [&](const GeneratorErrors& found) { return found.worst.*figure; });
    return figures.value_or(Measured{}).mean();
  };
  return {mean(&WorstSamples::share_of_error), mean(&WorstSamples::mse_of_others)};
}

int GeneratorMeasurements::find(const std::string& name) const {
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (candidates[i].name == name) return static_cast<int>(i);
  throw Error(ErrorCode::internal, "GeneratorMeasurements", "no candidate is called " + name);
}

GeneratorMeasurements measure_generators(const GeneratorComparison& comparison,
                                         const ReproduceOptions& options, const Progress& progress) {
  GeneratorMeasurements out{comparison.candidates, options.seeds, {}};
  const int benches = kControllers * options.seeds, count = static_cast<int>(out.candidates.size());
  out.errors.resize(static_cast<std::size_t>(benches) * out.candidates.size());
  std::vector<HalfRanges> ranges;
  for (const ControllerVariant controller : kControllerVariants)
    ranges.push_back(half_ranges(comparison.robot, controller));

  std::mutex reporting;
  int done = 0;
  const auto report = [&] {
    const std::lock_guard lock(reporting);
    if (progress) progress("residual generators", static_cast<double>(++done) / (benches * (count + 1)));
  };
  std::vector<IdentifiedBench> identified(benches);
  parallel_for(benches, options.threads, [&](int i) {
    const int controller = i / options.seeds;
    identified[i] = identified_bench({comparison.robot, kControllerVariants[controller], ranges[controller],
                                      options.seed + i % options.seeds},
                                     comparison);
    report();
  });
  parallel_for(benches * count, options.threads, [&](int i) {
    const GeneratorCandidate& candidate = out.candidates[i / benches];
    if (!candidate.first_seed_only || i % options.seeds == 0)
      out.errors[i] = candidate.errors(identified[i % benches]);
    report();
  });
  return out;
}

}  // namespace faultline
