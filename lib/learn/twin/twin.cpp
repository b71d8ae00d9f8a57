// SPDX-License-Identifier: MIT
#include "lib/learn/twin/twin.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/learn/twin/twin_draw.hpp"

namespace faultline {
namespace {

// Disjoint streams of random numbers: of the draws of attempts, and of their simulations.
constexpr std::uint64_t kDrawStream = 7;
constexpr std::uint64_t kAttemptSeeds = 500'000'000'000;  // more seeds than one learning uses

// Samples that a run must reach to be used: a few after the onset, or nearly all of a healthy one.
constexpr double kNeededAfterOnset = 3.0;  // after the onset
constexpr double kSpareAtTheEnd = 2.0;     // before the end of a healthy run

double control_period_s(const Twin& twin) {
  const double wanted = twin.options.control_period_s;
  const bool held = torque_between_samples(twin.identification->robot) == TorqueTiming::held;
  if (held || twin.sample_period_s <= wanted) return twin.sample_period_s;
  return twin.sample_period_s / std::round(twin.sample_period_s / wanted);
}

SimulationSpec spec_of(const Twin& twin, int attempt, Random& random) {
  SimulationSpec spec;
  spec.duration_s = twin_run_length_s(twin);
  spec.sample_period_s = twin.sample_period_s;
  spec.control_period_s = control_period_s(twin);
  spec.max_step_s =
      std::max(twin.options.control_period_s, twin.options.integration_share * spec.control_period_s);
  spec.motion = draw_motion(twin, random);
  spec.controller = draw_controller(twin, attempt == 0, random);
  spec.noise = draw_noise(twin, random);
  spec.drives = draw_drives(twin, random);
  for (const double speed : twin.motion->velocity_scale)
    spec.overspeed.push_back(twin.options.trip_speed * speed);
  spec.stops = draw_stops(twin, random);
  return spec;
}

/// Simulates one attempt; the run ends early if the drawn controller does not stabilise this robot.
TwinRun try_twin_run(const Twin& twin, const FaultLabel& label, std::uint64_t seed, int attempt) {
  Random random = Random::stream(seed, kDrawStream + static_cast<std::uint64_t>(attempt));
  Robot robot = draw(*twin.identification, random);
  robot = draw_day(twin, std::move(robot), random);
  SimulationSpec spec = spec_of(twin, attempt, random);
  TwinRun run;
  run.label = label;
  run.onset_s = spec.duration_s;
  if (label.kind != FaultKind::none) {
    const DrawRange& onset = twin.options.onset;
    run.onset_s = random.uniform(onset.low, onset.high) * spec.duration_s;
    spec.faults = draw_faults(twin, label, run.onset_s, random);
    run.end_s = spec.faults.front().end_s;
    run.size = spec.faults.front().size;
  }
  run.log = simulate(robot, spec, seed + static_cast<std::uint64_t>(attempt) * kAttemptSeeds).log;
  if (!twin.has_velocity) run.log.dq.clear();
  return run;
}

}  // namespace

DayDifferences DayDifferences::none(int joints) {
  const std::vector<double> zero(static_cast<std::size_t>(joints), 0.0);
  return {zero, zero, zero, zero, zero, std::vector<double>(zero.size(), 1.0)};
}

double twin_run_length_s(const Twin& twin) {
  return std::max({twin.options.least_length_s, twin.options.least_length_moves * usual_move_s(twin),
                   twin.options.least_length_samples * twin.sample_period_s});
}

TwinRun twin_run(const Twin& twin, const FaultLabel& label, std::uint64_t seed) {
  TwinRun run;
  for (int attempt = 0; attempt < twin.options.attempts; ++attempt) {
    run = try_twin_run(twin, label, seed, attempt);
    const double samples = label.kind == FaultKind::none ? -kSpareAtTheEnd : kNeededAfterOnset;
    const double needed_s = run.onset_s + samples * twin.sample_period_s;
    if (run.log.rows() > 0 && run.log.time.back() >= needed_s) break;
  }
  return run;
}

}  // namespace faultline
