// SPDX-License-Identifier: MIT
#include "lib/golden/default_tolerances.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "lib/golden/model_values.hpp"

namespace faultline {
namespace {

/// Two significant digits, so that a person can read and change it.
double readable(double value) { return std::strtod(fmt::format("{:.1e}", value).c_str(), nullptr); }

}  // namespace

Tolerances default_tolerances(const Model& model) {
  Tolerances t;
  const double two_samples = readable(2.0 * model.sample_period_s);
  for (const char* time : {"onset_s", "alarm_s", "end_s", "peak_s"}) t.by_channel[time] = {two_samples, 0.0};
  for (const char* confidence : {"confidence", "mlp_confidence", "rbfn_confidence"})
    t.by_channel[confidence] = {0.05, 0.0};
  t.by_channel["evidence"] = {0.5, 0.01};
  t.by_channel["model"] = {0.0, 0.002};
  for (const char* alarm : {"trigger", "threshold"}) t.by_channel[alarm] = {0.1, 0.01};
  for (const ParameterValue& value : values_of(model))
    if (value.std > 0.0) t.by_channel[value.name] = {readable(3.0 * value.std), 0.0};
  for (const char* residual : {"velocity_rms", "velocity_peak", "position_rms"})
    t.by_channel[residual] = {0.001, 0.02};
  t.by_channel["parameter"] = {0.0, 0.001};
  t.by_channel["parameter_std"] = {0.0, 0.05};
  for (int j = 0; j < model.residual.joints(); ++j) {
    t.by_channel[fmt::format("q{}", j + 1)] = {readable(0.02 * model.residual.healthy.position_rms[j]), 0.0};
    t.by_channel[fmt::format("dq{}", j + 1)] = {readable(0.02 * model.residual.healthy.velocity_rms[j]), 0.0};
  }
  t.length_may_differ = false;
  return t;
}

Tolerances default_tolerances(const ObservedIdentification& identification) {
  Tolerances t;
  for (const ParameterValue& p : identification.parameters)
    if (p.std > 0.0) t.by_channel[p.name] = {readable(0.1 * p.std), 0.0};
  return t;
}

}  // namespace faultline
