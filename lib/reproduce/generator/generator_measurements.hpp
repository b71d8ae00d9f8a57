// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/core/progress.hpp"
#include "lib/reproduce/generator/generator_candidates.hpp"
#include "lib/reproduce/page/result_table.hpp"
#include "lib/reproduce/protocol/reproduce_options.hpp"

namespace faultline {

/// Errors of every candidate, under every controller, in every experiment.
struct GeneratorMeasurements {
  std::vector<GeneratorCandidate> candidates;
  int seeds = 0;
  std::vector<std::optional<GeneratorErrors>> errors;  ///< candidate, then controller, then seed

  std::size_t index(int candidate, int controller, int seed) const;
  /// Mean over the outputs, or one of them; NaN for seeds without, nothing where the candidate does not
  /// apply.
  std::optional<Measured> mse(int candidate, int controller, GeneratorTest test) const;
  std::optional<Measured> mse(int candidate, int controller, GeneratorTest test, int output) const;
  /// Of the error in runs of moves; means over the seeds, NaN where the candidate does not apply.
  WorstSamples worst(int candidate, int controller) const;
  /// Number of the candidate of this name. Throws Error(internal) when there is none.
  int find(const std::string& name) const;
};

/// What is compared, and on which robot.
struct GeneratorComparison {
  Robot robot;
  std::vector<GeneratorCandidate> candidates;
  GeneratorScale scale;
  bool with_fast_logs = false;  ///< also identified from a log at 1 kHz
};

/// Identifies the robot under each controller and seed and measures all candidates on it.
GeneratorMeasurements measure_generators(const GeneratorComparison& comparison,
                                         const ReproduceOptions& options, const Progress& progress);

}  // namespace faultline
