// SPDX-License-Identifier: MIT
#include "lib/golden/tolerance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "lib/fault/fault_kind.hpp"
#include "lib/identify/parameter_space.hpp"
#include "lib/model/model.hpp"

namespace faultline {
namespace {

bool all_digits(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

double identified_std(const Identification& identification, const std::string& name) {
  for (const auto* list : {&identification.base_parameters, &identification.physical_parameters})
    for (const ParameterEstimate& parameter : *list)
      if (parameter.name == name && parameter.identifiable) return parameter.std;
  return std::numeric_limits<double>::quiet_NaN();
}

void add_robot(const Model& model, std::vector<ParameterValue>& values) {
  const ParameterSpace space = parameter_space(model.robot);
  const Eigen::VectorXd parameters =
      parameters_of(space, model.robot.chain, model.robot.torque_phi.value_or(0.0));
  for (int p = 0; p < space.timing(); ++p) {
    const std::string name = space.name(p);
    values.push_back(
        {"model_" + name, parameters[p], identified_std(model.identification, name), space.unit(p)});
  }
}

/// Two significant digits, so that a person can read and change it.
double readable(double value) { return std::strtod(fmt::format("{:.1e}", value).c_str(), nullptr); }

}  // namespace

double Tolerance::allowed(double expected) const { return absolute + relative * std::abs(expected); }

bool Tolerance::agree(double expected, double actual) const {
  if (std::isnan(expected) || std::isnan(actual)) return std::isnan(expected) && std::isnan(actual);
  if (std::isinf(expected) || std::isinf(actual)) return expected == actual;
  return std::abs(actual - expected) <= allowed(expected);
}

Tolerance tolerance_of(const ToleranceChain& chain, const std::string& channel, const std::string& family) {
  for (const Tolerances* tolerances : chain)
    for (const std::string& name : {channel, family})
      if (const auto found = tolerances->by_channel.find(name); found != tolerances->by_channel.end())
        return found->second;
  return {};
}

bool length_may_differ(const ToleranceChain& chain) {
  for (const Tolerances* tolerances : chain)
    if (tolerances->length_may_differ) return *tolerances->length_may_differ;
  return false;
}

const std::vector<std::string>& tolerance_families() {
  static const std::vector<std::string> families = {
      "onset_s",       "alarm_s",       "end_s",    "confidence",     "velocity_rms",
      "velocity_peak", "peak_s",        "q",        "position_rms",   "dq",
      "parameter",     "parameter_std", "evidence", "mlp_confidence", "rbfn_confidence",
      "model",         "trigger",       "threshold"};
  return families;
}

std::string tolerance_family(const std::string& channel) {
  for (const std::string& family : tolerance_families()) {
    if (channel == family) return family;
    const std::string prefix = family == "q" || family == "dq" ? family : family + "_";
    if (channel.rfind(prefix, 0) == 0 && all_digits(channel.substr(prefix.size()))) return family;
  }
  return "";
}

std::vector<ParameterValue> values_of(const Model& model) {
  std::vector<ParameterValue> values;
  if (!model.has_mechanics()) return values;
  add_robot(model, values);
  const double no_std = std::numeric_limits<double>::quiet_NaN();
  for (int k = 1; k < kFaultKinds; ++k) {
    const auto kind = static_cast<FaultKind>(k);
    values.push_back(
        {std::string("threshold_") + to_string(kind), model.explain.limits.of(kind), no_std, "nats"});
  }
  return values;
}

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
    t.by_channel[fmt::format("q{}", Joint::at(j))] = {readable(0.02 * model.residual.healthy.position_rms[j]),
                                                      0.0};
    t.by_channel[fmt::format("dq{}", Joint::at(j))] = {
        readable(0.02 * model.residual.healthy.velocity_rms[j]), 0.0};
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
