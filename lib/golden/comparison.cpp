// SPDX-License-Identifier: MIT
#include "lib/golden/comparison.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "lib/core/number_text.hpp"
#include "lib/fault/fault_kind.hpp"

namespace faultline {
namespace {

std::string brief_value(double number) { return digits_text(number, 6); }

void compare_words(const std::string& channel, const std::string& expected, const std::string& actual,
                   Comparison& comparison, bool may_differ = false, double allowed = kNoNumber) {
  const bool differs = expected != actual && !may_differ;
  if (differs) comparison.differences.push_back({channel, kNoNumber, expected, actual, allowed});
  comparison.lines.push_back({channel + " " + expected, channel + " " + actual, differs});
}

/// Adds a difference when `got` is out of tolerance; returns whether it is.
bool compare_number(const std::string& channel, const std::string& family, double wanted, double got,
                    double time, const ToleranceChain& tolerances, Comparison& comparison) {
  const Tolerance tolerance = tolerance_of(tolerances, channel, family);
  if (tolerance.agree(wanted, got)) return false;
  comparison.differences.push_back(
      {channel, time, brief_value(wanted), brief_value(got), tolerance.allowed(wanted)});
  return true;
}

std::string line_of(const JointResidual& r) {
  return fmt::format("residual of joint {}: velocity_rms {}, velocity_peak {} at {} s, position_rms {}",
                     r.joint, brief_value(r.velocity_rms), brief_value(r.velocity_peak),
                     brief_value(r.velocity_peak_s), brief_value(r.position_rms));
}

void compare_residuals(const Observation& expected, const Observation& actual,
                       const ToleranceChain& tolerances, Comparison& comparison) {
  const std::size_t common = std::min(expected.residuals.size(), actual.residuals.size());
  if (expected.residuals.size() != actual.residuals.size())
    compare_words("joints", fmt::format("{}", expected.residuals.size()),
                  fmt::format("{}", actual.residuals.size()), comparison);
  for (std::size_t j = 0; j < common; ++j) {
    const JointResidual &wanted = expected.residuals[j], &got = actual.residuals[j];
    bool differs = false;
    const auto number = [&](const char* family, double one, double other, double time) {
      differs |= compare_number(fmt::format("{}_{}", family, wanted.joint), family, one, other, time,
                                tolerances, comparison);
    };
    number("velocity_rms", wanted.velocity_rms, got.velocity_rms, NAN);
    number("velocity_peak", wanted.velocity_peak, got.velocity_peak, wanted.velocity_peak_s);
    number("peak_s", wanted.velocity_peak_s, got.velocity_peak_s,
           std::fmin(wanted.velocity_peak_s, got.velocity_peak_s));
    number("position_rms", wanted.position_rms, got.position_rms, NAN);
    comparison.lines.push_back({line_of(wanted), line_of(got), differs});
  }
}

/// Indices of points of equal time, in order of time.
std::vector<std::pair<int, int>> common_points(const Trace& a, const Trace& b) {
  std::vector<std::pair<int, int>> pairs;
  for (int i = 0, j = 0; i < a.points() && j < b.points();) {
    const double near = 1e-9 * std::max(1.0, std::abs(a.time[i]));
    if (std::abs(a.time[i] - b.time[j]) <= near)
      pairs.emplace_back(i++, j++);
    else
      ++(a.time[i] < b.time[j] ? i : j);
  }
  return pairs;
}

/// The first point, by time, that only one trace has is a difference.
void compare_times(const Trace& expected, const Trace& actual, const std::vector<std::pair<int, int>>& points,
                   Comparison& comparison) {
  if (points.size() == expected.time.size() && points.size() == actual.time.size()) return;
  std::size_t k = 0;
  while (k < points.size() && points[k] == std::pair(static_cast<int>(k), static_cast<int>(k))) ++k;
  double time_s = std::numeric_limits<double>::infinity();
  const bool is_in_expected = k < expected.time.size();
  if (is_in_expected) time_s = expected.time[k];
  const bool is_in_actual = k < actual.time.size() && actual.time[k] < time_s;
  if (is_in_actual) time_s = actual.time[k];
  const std::string there = fmt::format("a sample at {} s", time_s);
  const bool is_expected = is_in_expected && !is_in_actual;
  const std::string expected_text = is_expected ? there : "", actual_text = is_expected ? "" : there;
  comparison.differences.push_back({"t", time_s, expected_text, actual_text, kNoNumber});
  comparison.lines.push_back({expected_text, actual_text, true});
}

/// Compares what was predicted at the same times, channel by channel: of each that differs, the first time
/// and both values. The first time that only one trace has is a difference unless the length may differ.
void compare_traces(const Trace& expected, const Trace& actual, const ToleranceChain& tolerances,
                    Comparison& comparison) {
  const auto points = common_points(expected, actual);
  if (!length_may_differ(tolerances)) compare_times(expected, actual, points, comparison);
  for (std::size_t c = 0; c < expected.channels.size(); ++c) {
    const std::string& channel = expected.channels[c];
    const auto same = std::find(actual.channels.begin(), actual.channels.end(), channel);
    if (same == actual.channels.end()) {
      comparison.differences.push_back({channel, kNoNumber, "predicted", "missing channel", kNoNumber});
      comparison.lines.push_back({channel + " predicted", "", true});
      continue;
    }
    const auto& there = actual.values[same - actual.channels.begin()];
    const Tolerance tolerance = tolerance_of(tolerances, channel, tolerance_family(channel));
    std::vector<std::pair<int, int>> differing;
    std::copy_if(points.begin(), points.end(), std::back_inserter(differing), [&](const auto& point) {
      return !tolerance.agree(expected.values[c][point.first], there[point.second]);
    });
    if (differing.empty()) continue;
    const auto [i, j] = differing.front();
    const double wanted = expected.values[c][i], got = there[j], time = expected.time[i];
    comparison.differences.push_back(
        {channel, time, brief_value(wanted), brief_value(got), tolerance.allowed(wanted)});
    const auto line = [&, i = i](double number) {
      return fmt::format("{} predicted {} at {} s", channel, brief_value(number), expected.time[i]);
    };
    comparison.lines.push_back(
        {line(wanted), fmt::format("{} ({} of {} points differ)", line(got), differing.size(), points.size()),
         true});
  }
}

/// Of a model; an identified one has a standard deviation, or is not identifiable.
std::string value_line(const ParameterValue& p) {
  return fmt::format("{} {} {}", p.name, brief_value(p.value), p.unit);
}

std::string estimate_line(const ParameterValue& p) {
  return value_line(p) + (std::isnan(p.std) ? " (not identifiable)" : ", std " + brief_value(p.std));
}

/// Compares values by their names. `identified` ones have a standard deviation, or are not identifiable.
void compare_values(const std::vector<ParameterValue>& expected, const std::vector<ParameterValue>& actual,
                    bool identified, const ToleranceChain& tolerances, Comparison& comparison) {
  for (const ParameterValue& p : expected) {
    const ParameterValue* const there = find_value(actual, p.name);
    if (!there) {
      comparison.differences.push_back({p.name, kNoNumber, brief_value(p.value), "", kNoNumber});
      comparison.lines.push_back({estimate_line(p), "", true});
      continue;
    }
    const auto line = identified ? estimate_line : value_line;
    const std::string family =
        identified ? "parameter" : p.name.substr(0, p.name.find('_'));  // of "threshold_locked_2"
    bool differs = compare_number(p.name, family, p.value, there->value, NAN, tolerances, comparison);
    if (identified)
      differs |=
          compare_number(p.name + "_std", "parameter_std", p.std, there->std, NAN, tolerances, comparison);
    comparison.lines.push_back({line(p), line(*there), differs});
  }
  for (const ParameterValue& p : actual) {
    if (find_value(expected, p.name)) continue;
    comparison.differences.push_back({p.name, kNoNumber, "", brief_value(p.value), kNoNumber});
    comparison.lines.push_back({"", estimate_line(p), true});
  }
}

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

/// Adds what is not within its tolerance in one event: times and confidence, then the reasons. Returns
/// whether anything is.
bool compare_pair(const ObservedEvent& expected, const ObservedEvent& actual,
                  const ToleranceChain& tolerances, Comparison& found) {
  const std::size_t before = found.differences.size();
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
  return found.differences.size() > before;
}

}  // namespace

Comparison compare(const Observation& expected, const Observation& actual, const ToleranceChain& tolerances) {
  Comparison comparison;
  compare_words("verdict", expected.verdict, actual.verdict, comparison);
  if (actual.verdict == kUnusable || expected.verdict == kUnusable) {
    if (!comparison.same()) comparison.lines.back().actual += ": " + actual.reason;
    return comparison;
  }
  compare_words("rows", std::to_string(expected.rows), std::to_string(actual.rows), comparison,
                length_may_differ(tolerances), 0.0);
  compare_events(expected.events, actual.events, tolerances, comparison);
  compare_residuals(expected, actual, tolerances, comparison);
  compare_traces(expected.trace, actual.trace, tolerances, comparison);
  return comparison;
}

Comparison compare(const ObservedIdentification& expected, const ObservedIdentification& actual,
                   const ToleranceChain& tolerances) {
  Comparison comparison;
  compare_words("status", expected.status, actual.status, comparison);
  if (!comparison.same() && !actual.reason.empty()) comparison.lines.back().actual += ": " + actual.reason;
  compare_words("method", expected.method, actual.method, comparison);
  compare_values(expected.parameters, actual.parameters, true, tolerances, comparison);
  return comparison;
}

Comparison compare(const std::vector<ParameterValue>& expected, const std::vector<ParameterValue>& actual,
                   const ToleranceChain& tolerances) {
  Comparison comparison;
  if (!expected.empty() && !actual.empty()) compare_values(expected, actual, false, tolerances, comparison);
  return comparison;
}

bool Difference::changes_verdict() const {
  for (const char* said : {"verdict", "event", "status", "joints"})
    if (channel == said) return true;
  return false;
}

bool Comparison::changes_verdict() const {
  return std::any_of(differences.begin(), differences.end(),
                     [](const Difference& difference) { return difference.changes_verdict(); });
}

const Difference* first_divergence(const Comparison& comparison) {
  const Difference* first = nullptr;
  for (const Difference& difference : comparison.differences)
    if (!std::isnan(difference.time_s) && (!first || difference.time_s < first->time_s)) first = &difference;
  if (!first && !comparison.differences.empty()) first = &comparison.differences.front();
  return first;
}

void compare_events(const std::vector<ObservedEvent>& expected, const std::vector<ObservedEvent>& actual,
                    const ToleranceChain& tolerances, Comparison& comparison) {
  std::vector<char> used(actual.size(), 0);
  for (const ObservedEvent& event : expected) {
    const int partner = nearest(event, actual, used);
    if (partner < 0) {
      comparison.differences.push_back({"event", event.onset_s, name_of(event.label), "", kNoNumber});
      comparison.lines.push_back({line_of(event), "", true});
      continue;
    }
    used[partner] = 1;
    const bool differs = compare_pair(event, actual[partner], tolerances, comparison);
    comparison.lines.push_back({line_of(event), line_of(actual[partner]), differs});
  }
  for (std::size_t i = 0; i < actual.size(); ++i) {
    if (used[i]) continue;
    comparison.differences.push_back({"event", actual[i].onset_s, "", name_of(actual[i].label), kNoNumber});
    comparison.lines.push_back({"", line_of(actual[i]), true});
  }
}

}  // namespace faultline
