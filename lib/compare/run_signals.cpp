// SPDX-License-Identifier: MIT
#include "lib/compare/run_signals.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/error.hpp"
#include "lib/core/statistics.hpp"
#include "lib/log/time_axis.hpp"
#include "lib/residual/residuals.hpp"

namespace faultline {
namespace {

/// Returns the polynomial through samples [begin, end) at `at` (Lagrange).
double through(const std::vector<double>& time, const std::vector<double>& values, std::size_t begin,
               std::size_t end, double at) {
  double sum = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    double weight = values[i];
    for (std::size_t k = begin; k < end; ++k)
      if (k != i) weight *= (at - time[k]) / (time[i] - time[k]);
    sum += weight;
  }
  return sum;
}

bool has_gap(const std::vector<double>& time, std::size_t begin, std::size_t end, double gap_s) {
  for (std::size_t i = begin + 1; i < end; ++i)
    if (time[i] - time[i - 1] > gap_s) return true;
  return false;
}

constexpr int kLeastRows = 8;

void add(std::vector<RunSignal>& to, const char* quantity, const JointSignals& values,
         const std::vector<double>& time) {
  for (std::size_t j = 0; j < values.size(); ++j)
    to.push_back({quantity, Joint::at(static_cast<int>(j)), time, values[j]});
}

void add_residuals(RunSignals& run, const Log& log, const ResidualGenerator& generator) {
  if (generator.joints() == 0 || log.tau.empty()) return;
  ResidualState state;
  const Residuals residuals = compute_residuals(generator, log, state);
  for (int j = 0; j < residuals.joints(); ++j) {
    RunSignal signal{"residual", Joint::at(j), {}, {}};
    for (int i = 0; i < residuals.count(); ++i) {
      signal.time.push_back(residuals.time[i] - run.start_s);
      signal.values.push_back(residuals.velocity(j, i));
    }
    run.signals.push_back(std::move(signal));
  }
}

}  // namespace

ValueBetween value_between(const std::vector<double>& time, const std::vector<double>& values, double at,
                           double gap_s) {
  if (time.empty() || !(at >= time.front()) || at > time.back()) return {kNotKnown, kNotKnown};
  const auto after = static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), at) - time.begin());
  if (time[after] == at) return {values[after], 0.0};
  const std::size_t left = after - 1;
  if (time[after] - time[left] > gap_s) return {kNotKnown, kNotKnown};
  const std::size_t begin = left > 0 ? left - 1 : 0, end = std::min(after + 2, time.size());
  const double line = through(time, values, left, after + 1, at);
  const double wide = through(time, values, begin, end, at);
  if (end - begin < 4 || !std::isfinite(wide) || has_gap(time, begin, end, gap_s))
    return {line, std::isfinite(wide) ? std::abs(wide - line) : 0.0};
  return {wide, std::abs(wide - through(time, values, begin, end - 1, at))};
}

double noise_of(const std::vector<double>& values) {
  std::vector<double> third;
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < values.size(); ++i)
    if (const double moved = std::abs(values[i] - values[i - 1]); moved > 0.0) step = std::min(step, moved);
  for (std::size_t i = 3; i < values.size(); ++i) {
    const double d = std::abs(values[i] - 3.0 * values[i - 1] + 3.0 * values[i - 2] - values[i - 3]);
    if (std::isfinite(d)) third.push_back(d);
  }
  if (third.empty()) return 0.0;
  // The standard deviation of normal noise is 1.4826 times its median magnitude; 1 -3 3 -1 multiplies the
  // variance of white noise by 20; rounding to steps of 1 has the variance 1 / 12.
  const double smooth = 1.4826 * upper_median(third) / std::sqrt(20.0);
  return std::isfinite(step) ? std::max(smooth, step / std::sqrt(12.0)) : smooth;
}

const RunSignal* RunSignals::find(const std::string& quantity, Joint joint) const {
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
  std::vector<double> time = log.time;
  for (double& t : time) t -= run.start_s;
  run.length_s = time.back();
  run.period_s = median_step(time);
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
