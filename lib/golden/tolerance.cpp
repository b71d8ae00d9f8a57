// SPDX-License-Identifier: MIT
#include "lib/golden/tolerance.hpp"

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

bool all_digits(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

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

}  // namespace faultline
