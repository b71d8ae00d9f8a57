// SPDX-License-Identifier: MIT
#include "lib/report/comparison_junit.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/report/text.hpp"

namespace faultline {
namespace {

std::string body_of(const SignalDifference& signal, const std::vector<char>& turns) {
  if (!signal.judged)
    return "      <skipped message=\"is not judged: it must differ between these runs\"/>\n";
  if (std::isnan(signal.diverges_s)) return "";
  return fmt::format(
      "      <failure type=\"{0}\" message=\"{0} of joint {1} differs from {2} on\">largest difference {3} {4} at {5}, "
      "threshold {6} {4}, rms {7} {4}</failure>\n",
      escaped_markup(signal.quantity), signal.joint, seconds_text(signal.diverges_s),
      value_text(signal.largest), escaped_markup(unit_of(signal, turns)), seconds_text(signal.largest_s),
      value_text(signal.threshold), value_text(signal.rms));
}

}  // namespace

std::string comparison_junit(const RunComparison& comparison, const std::vector<char>& turns) {
  std::vector<JunitCase> cases = {{"motion", ""}};
  if (!comparison.alignment.same_motion)
    cases.front().body = fmt::format("      <failure type=\"motion\" message=\"{}\"/>\n",
                                     escaped_markup(verdict_of(comparison)));
  for (const SignalDifference& signal : comparison.signals)
    cases.push_back({fmt::format("{} of joint {}", signal.quantity, signal.joint), body_of(signal, turns)});
  return junit_suite(comparison.second, cases, {"skipped"});
}

}  // namespace faultline
