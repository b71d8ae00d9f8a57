// SPDX-License-Identifier: MIT
#include "lib/golden/compare_events.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "lib/core/number_text.hpp"
#include "lib/fault/label_text.hpp"

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

/// Notes what is not within its tolerance in one event.
class PairComparison {
 public:
  PairComparison(const ObservedEvent& expected, const ObservedEvent& actual, const ToleranceChain& tolerances)
      : expected_(expected), actual_(actual), tolerances_(tolerances) {}

  void compare_event() {
    number("onset_s", expected_.onset_s, actual_.onset_s, std::fmin(expected_.onset_s, actual_.onset_s));
    number("alarm_s", expected_.alarm_s, actual_.alarm_s, std::fmin(expected_.alarm_s, actual_.alarm_s));
    number("end_s", expected_.end_s, actual_.end_s, std::fmin(expected_.end_s, actual_.end_s));
    number("confidence", expected_.confidence, actual_.confidence, expected_.onset_s);
  }

  void compare_reasons() {
    number("evidence", expected_.evidence, actual_.evidence, expected_.onset_s);
    words("decided_by", expected_.decided_by, actual_.decided_by);
    compare_opinion("mlp", expected_.opinions.mlp, actual_.opinions.mlp);
    compare_opinion("rbfn", expected_.opinions.rbfn, actual_.opinions.rbfn);
    words("could_also_be", names_of(expected_.could_also_be), names_of(actual_.could_also_be));
  }

  const std::vector<Difference>& differences() const { return differences_; }

 private:
  void number(const char* channel, double wanted, double got, double time) {
    const Tolerance tolerance = tolerance_of(tolerances_, channel, channel);
    if (tolerance.agree(wanted, got)) return;
    differences_.push_back(
        {channel, time, digits_text(wanted, 6), digits_text(got, 6), tolerance.allowed(wanted)});
  }

  void words(const char* channel, const std::string& wanted, const std::string& got) {
    if (wanted != got) differences_.push_back({channel, expected_.onset_s, wanted, got, kNoNumber});
  }

  void compare_opinion(const std::string& network, const Opinion& wanted, const Opinion& got) {
    words(network.c_str(), name_of(wanted.label), name_of(got.label));
    if (wanted.label == got.label)
      number((network + "_confidence").c_str(), wanted.confidence, got.confidence, expected_.onset_s);
  }

  const ObservedEvent& expected_;
  const ObservedEvent& actual_;
  const ToleranceChain& tolerances_;
  std::vector<Difference> differences_;
};

std::vector<Difference> compare_pair(const ObservedEvent& expected, const ObservedEvent& actual,
                                     const ToleranceChain& tolerances) {
  PairComparison pair(expected, actual, tolerances);
  pair.compare_event();
  pair.compare_reasons();
  return pair.differences();
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
