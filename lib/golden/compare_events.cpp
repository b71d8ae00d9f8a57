// SPDX-License-Identifier: MIT
#include "lib/golden/compare_events.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lib/core/number_text.hpp"
#include "lib/fault/label_text.hpp"

namespace faultline {
namespace {

std::string when(double time_s) { return std::isnan(time_s) ? "unknown" : seconds_text(time_s); }

std::string name_of(const FaultLabel& label) { return label_text(label, " joint "); }

std::string line_of(const FaultEvent& e) {
  return fmt::format("event {}: onset {}, alarm {}, end {}, confidence {:.3f}", name_of(e.label),
                     when(e.onset_s), when(e.alarm_s), when(e.end_s), e.confidence);
}

/// The unused event of that label whose onset is nearest; -1 for none.
int nearest(const FaultEvent& wanted, const std::vector<FaultEvent>& events, const std::vector<char>& used) {
  int best = -1;
  double distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (used[i] || !(events[i].label == wanted.label)) continue;
    const double d = std::abs(events[i].onset_s - wanted.onset_s);
    if (best >= 0 && !(d < distance)) continue;
    best = static_cast<int>(i);
    distance = d;
  }
  return best;
}

/// Adds what is not within its tolerance; whether something was.
bool compare_pair(const FaultEvent& expected, const FaultEvent& actual, const ToleranceChain& tolerances,
                  std::vector<Difference>& differences) {
  const std::size_t before = differences.size();
  const auto number = [&](const char* channel, double wanted, double got, double time) {
    const Tolerance tolerance = tolerance_of(tolerances, channel, channel);
    if (tolerance.agree(wanted, got)) return;
    differences.push_back(
        {channel, time, digits_text(wanted, 6), digits_text(got, 6), tolerance.allowed(wanted)});
  };
  number("onset_s", expected.onset_s, actual.onset_s, std::fmin(expected.onset_s, actual.onset_s));
  number("alarm_s", expected.alarm_s, actual.alarm_s, std::fmin(expected.alarm_s, actual.alarm_s));
  number("end_s", expected.end_s, actual.end_s, std::fmin(expected.end_s, actual.end_s));
  number("confidence", expected.confidence, actual.confidence, expected.onset_s);
  return differences.size() > before;
}

}  // namespace

void compare_events(const std::vector<FaultEvent>& expected, const std::vector<FaultEvent>& actual,
                    const ToleranceChain& tolerances, Comparison& comparison) {
  std::vector<char> used(actual.size(), 0);
  for (const FaultEvent& event : expected) {
    const int partner = nearest(event, actual, used);
    if (partner < 0) {
      comparison.differences.push_back({"event", event.onset_s, name_of(event.label), "", kNoNumber});
      comparison.lines.push_back({line_of(event), "", true});
      continue;
    }
    used[partner] = 1;
    const bool differs = compare_pair(event, actual[partner], tolerances, comparison.differences);
    comparison.lines.push_back({line_of(event), line_of(actual[partner]), differs});
  }
  for (std::size_t i = 0; i < actual.size(); ++i) {
    if (used[i]) continue;
    comparison.differences.push_back({"event", actual[i].onset_s, "", name_of(actual[i].label), kNoNumber});
    comparison.lines.push_back({"", line_of(actual[i]), true});
  }
}

}  // namespace faultline
