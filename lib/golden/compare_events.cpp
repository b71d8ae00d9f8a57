// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <utility>

#include "lib/core/number_text.hpp"
#include "lib/fault/fault_kind.hpp"
#include "lib/golden/comparison.hpp"

namespace faultline {
namespace {

std::string when(double time_s) { return std::isnan(time_s) ? "unknown" : seconds_text(time_s); }

std::string name_of(const FaultLabel& label) { return label_text(label, " joint "); }

std::string names_of(const std::vector<FaultLabel>& labels) {
  std::vector<std::string> names;
  for (const FaultLabel& label : labels) names.push_back(name_of(label));
  return names.empty() ? "nothing else" : fmt::format("{}", fmt::join(names, ", "));
}

std::string text_of(const Opinion& opinion) {
  return fmt::format("{} {:.3f}", name_of(opinion.label), opinion.confidence);
}

std::string line_of(const ObservedEvent& e) {
  const std::string line =
      fmt::format("event {}: onset {}, alarm {}, end {}, confidence {:.3f}", name_of(e.label),
                  when(e.onset_s), when(e.alarm_s), when(e.end_s), e.confidence);
  return line + fmt::format(", evidence {}, decided by {}, MLP {}, RBFN {}, could also be {}",
                            digits_text(e.evidence, 6), e.decided_by, text_of(e.opinions.mlp),
                            text_of(e.opinions.rbfn), names_of(e.could_also_be));
}

/// The unused event of that label whose onset is nearest; -1 for none.
int nearest(const ObservedEvent& wanted, const std::vector<ObservedEvent>& events,
            const std::vector<char>& used) {
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

/// What is not within its tolerance in one event: times and confidence, then the reasons.
std::vector<Difference> compare_pair(const ObservedEvent& expected, const ObservedEvent& actual,
                                     const ToleranceChain& tolerances) {
  Comparison found;
  const auto number = [&](const std::string& channel, double wanted, double got, double time) {
    compare_number(channel, channel, wanted, got, time, tolerances, found);
  };
  const auto time = [&](const char* channel, double wanted, double got) {
    number(channel, wanted, got, std::fmin(wanted, got));
  };
  const auto words = [&](const std::string& channel, const std::string& wanted, const std::string& got) {
    if (wanted != got) found.differences.push_back({channel, expected.onset_s, wanted, got, kNoNumber});
  };
  const auto opinion = [&](const std::string& network, const Opinion& wanted, const Opinion& got) {
    words(network, name_of(wanted.label), name_of(got.label));
    if (wanted.label == got.label)
      number(network + "_confidence", wanted.confidence, got.confidence, expected.onset_s);
  };
  time("onset_s", expected.onset_s, actual.onset_s);
  time("alarm_s", expected.alarm_s, actual.alarm_s);
  time("end_s", expected.end_s, actual.end_s);
  number("confidence", expected.confidence, actual.confidence, expected.onset_s);
  number("evidence", expected.evidence, actual.evidence, expected.onset_s);
  words("decided_by", expected.decided_by, actual.decided_by);
  opinion("mlp", expected.opinions.mlp, actual.opinions.mlp);
  opinion("rbfn", expected.opinions.rbfn, actual.opinions.rbfn);
  words("could_also_be", names_of(expected.could_also_be), names_of(actual.could_also_be));
  return std::move(found.differences);
}

}  // namespace

Comparison compare_events(const std::vector<ObservedEvent>& expected,
                          const std::vector<ObservedEvent>& actual, const ToleranceChain& tolerances) {
  Comparison comparison;
  std::vector<char> used(actual.size(), 0);
  for (const ObservedEvent& event : expected) {
    const int partner = nearest(event, actual, used);
    if (partner < 0) {
      comparison.differences.push_back({"event", event.onset_s, name_of(event.label), "", kNoNumber});
      comparison.lines.push_back({line_of(event), "", true});
      continue;
    }
    used[partner] = 1;
    const std::vector<Difference> found = compare_pair(event, actual[partner], tolerances);
    comparison.differences.insert(comparison.differences.end(), found.begin(), found.end());
    comparison.lines.push_back({line_of(event), line_of(actual[partner]), !found.empty()});
  }
  for (std::size_t i = 0; i < actual.size(); ++i) {
    if (used[i]) continue;
    comparison.differences.push_back({"event", actual[i].onset_s, "", name_of(actual[i].label), kNoNumber});
    comparison.lines.push_back({"", line_of(actual[i]), true});
  }
  return comparison;
}

}  // namespace faultline
