// SPDX-License-Identifier: MIT
#include "lib/model/twin/twin_text.hpp"

#include <fmt/format.h>

#include "lib/model/twin/twin_fields.hpp"

namespace faultline {
namespace {

std::string value_text(double value) { return fmt::format("{:g}", value); }
std::string value_text(int value) { return fmt::format("{}", value); }
std::string value_text(const DrawRange& range) {
  const char* sign = range.either_sign ? "+-" : "";
  const char* spread = range.spread == Spread::log_uniform ? ", log-uniform" : "";
  return fmt::format("{}{:g} to {:g}{}", sign, range.low, range.high, spread);
}

std::string line(const std::string& name, const std::string& value, const std::string& words) {
  return fmt::format("  {:<22} {:<28} {}\n", name, value, words);
}

std::string fault_text(const FaultDescription& fault, const TwinFault& twin) {
  std::string text;
  for (int s = 0; s < fault.size_count; ++s)
    text += line(s == 0 ? fault.name : "", value_text(twin.size[s]),
                 std::string("of ") + usual_of(fault.size[s].measure));
  if (fault.size_count == 0) text += line(fault.name, "-", "has no size");
  if (fault.passes) text += line("", value_text(twin.length_s), "s, how long it lasts");
  return text;
}

}  // namespace

std::string twin_text(const TwinOptions& options) {
  std::string text = "Simulated runs of the identified robot that a model is learned and tested on\n\nRuns\n";
  visit_twin_fields(options, [&](const char* key, const auto& value, const char* words) {
    text += line(key, value_text(value), words);
  });
  text += "\nSizes of faults, against what is usual for the joint in the healthy logs\n";
  for (int k = 0; k < kFaultKinds; ++k) {
    const FaultKind kind = static_cast<FaultKind>(k);
    if (describe(kind).place != FaultPlace::nowhere && kind != FaultKind::unknown)
      text += fault_text(describe(kind), options.faults[k]);
  }
  return text;
}

}  // namespace faultline
