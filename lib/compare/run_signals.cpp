// SPDX-License-Identifier: MIT
#include "lib/compare/run_signals.hpp"

#include "lib/core/error.hpp"
#include "lib/core/statistics.hpp"
#include "lib/residual/residuals.hpp"

namespace faultline {
namespace {

constexpr int kLeastRows = 8;

std::vector<double> from_start(const std::vector<double>& time) {
  std::vector<double> shifted;
  for (const double t : time) shifted.push_back(t - time.front());
  return shifted;
}

void add(std::vector<RunSignal>& to, const char* quantity, const JointSignals& values,
         const std::vector<double>& time) {
  for (std::size_t j = 0; j < values.size(); ++j)
    to.push_back({quantity, static_cast<int>(j) + 1, time, values[j]});
}

void add_residuals(RunSignals& run, const Log& log, const ResidualGenerator& generator) {
  if (generator.joints() == 0 || log.tau.empty()) return;
  ResidualState state;
  const Residuals residuals = compute_residuals(generator, log, state);
  for (int j = 0; j < residuals.joints(); ++j) {
    RunSignal signal{"residual", j + 1, {}, {}};
    for (int i = 0; i < residuals.count(); ++i) {
      signal.time.push_back(residuals.time[i] - run.start_s);
      signal.values.push_back(residuals.velocity(j, i));
    }
    run.signals.push_back(std::move(signal));
  }
}

}  // namespace

const RunSignal* RunSignals::find(const std::string& quantity, int joint) const {
  for (const RunSignal& signal : signals)
    if (signal.quantity == quantity && signal.joint == joint) return &signal;
  return nullptr;
}

RunSignals run_signals(const std::string& name, const Log& log, const ResidualGenerator* generator) {
  if (log.rows() < kLeastRows)
    throw Error(
        ErrorCode::input, name,
        "has " + std::to_string(log.rows()) + " rows; a comparison needs " + std::to_string(kLeastRows));
  RunSignals run;
  run.name = name;
  run.start_s = log.time.front();
  const std::vector<double> time = from_start(log.time);
  run.length_s = time.back();
  std::vector<double> steps;
  for (std::size_t i = 1; i < time.size(); ++i) steps.push_back(time[i] - time[i - 1]);
  run.period_s = upper_median(steps);
  add(run.signals, "position", log.q, time);
  add(run.signals, "velocity", log.dq, time);
  add(run.signals, "torque", log.tau, time);
  if (generator) add_residuals(run, log, *generator);
  run.by_reference = !log.q_ref.empty();
  add(run.motion, "reference", run.by_reference ? log.q_ref : log.q, time);
  return run;
}

RunSignals by_positions(RunSignals run) {
  run.by_reference = false;
  run.motion.clear();
  for (const RunSignal& signal : run.signals)
    if (signal.quantity == "position") run.motion.push_back(signal);
  return run;
}

}  // namespace faultline
