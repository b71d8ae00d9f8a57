// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/compare/compare_runs.hpp"
#include "lib/core/json_values.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/outgoing/json_text.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kWidth = 100;

const char* kind_text(const RunAlignment& alignment) {
  if (alignment.warped()) return "warp";
  return alignment.kind == AlignmentKind::motion ? "shift" : "time";
}

std::string when(const SignalDifference& signal) {
  if (!signal.judged) return "not judged";
  return std::isnan(signal.diverges_s) ? "-" : seconds_text(signal.diverges_s);
}

std::string line_of(const SignalDifference& s, const std::vector<char>& turns) {
  return fmt::format("  {:<9}{:>5}  {:<6}{:>10}{:>11}{:>12}{:>11}{:>12}\n", s.quantity, s.joint,
                     unit_of(s, turns), value_text(s.rms), value_text(s.largest),
                     std::isnan(s.largest_s) ? "-" : seconds_text(s.largest_s), value_text(s.threshold),
                     when(s));
}

Json signal_json(const SignalDifference& s, const std::vector<char>& turns) {
  return {{"quantity", s.quantity},
          {"joint", s.joint.number()},
          {"unit", unit_of(s, turns)},
          {"rms", number_or_null(s.rms)},
          {"first_rms", number_or_null(s.first_rms)},
          {"second_rms", number_or_null(s.second_rms)},
          {"largest", number_or_null(s.largest)},
          {"largest_s", number_or_null(s.largest_s)},
          {"noise", number_or_null(s.noise)},
          {"threshold", number_or_null(s.threshold)},
          {"beyond", number_or_null(s.beyond)},
          {"judged", s.judged},
          {"diverges_s", number_or_null(s.diverges_s)}};
}

Json run_json(const std::string& name, double length_s, double period_s) {
  return {{"log", name}, {"length_s", length_s}, {"sample_period_s", period_s}};
}

}  // namespace

const char* unit_of(const SignalDifference& signal, const std::vector<char>& joints_turn) {
  const std::string& quantity = signal.quantity;
  const int j = signal.joint.index();
  const bool turns = j >= std::ssize(joints_turn) || joints_turn[j];
  if (quantity == "position") return turns ? "rad" : "m";
  if (quantity == "velocity") return turns ? "rad/s" : "m/s";
  if (quantity == "torque") return turns ? "N m" : "N";
  return "1";
}

std::string verdict_of(const RunComparison& comparison) {
  const SignalDifference* first = comparison.first_divergence();
  if (!comparison.alignment.same_motion) {
    const std::string motions = "The runs are different motions";
    if (first)
      return fmt::format("{}; their residuals differ from {} on, first that of joint {}.", motions,
                         seconds_text(first->diverges_s), first->joint);
    const bool judged = std::any_of(comparison.signals.begin(), comparison.signals.end(),
                                    [](const SignalDifference& signal) { return signal.judged; });
    return judged ? motions + "; their residuals are the same within noise." : motions + ".";
  }
  if (!first) return "The runs are the same within noise.";
  return fmt::format("The runs differ from {} on: first the {} of joint {}.", seconds_text(first->diverges_s),
                     first->quantity, first->joint);
}

std::string to_text(const RunComparison& comparison, const std::vector<char>& turns) {
  std::string text =
      fmt::format("{}\n\n  first   {}, {} at {} each\n  second  {}, {} at {} each\n  compared {} of them\n\n",
                  verdict_of(comparison), printable(comparison.first),
                  seconds_text(comparison.first_length_s), value_text(comparison.first_period_s) + " s",
                  printable(comparison.second), seconds_text(comparison.second_length_s),
                  value_text(comparison.second_period_s) + " s", seconds_text(comparison.compared_s));
  text +=
      wrapped(fmt::format("Aligned by {}: {}.", kind_text(comparison.alignment), comparison.alignment.why),
              "", kWidth);
  text += "\nDifference, second minus first; times from the start of the first run:\n\n";
  text += fmt::format("  {:<9}{:>5}  {:<6}{:>10}{:>11}{:>12}{:>11}{:>12}\n", "", "joint", "unit", "rms",
                      "largest", "at", "threshold", "diverges at");
  for (const SignalDifference& signal : comparison.signals) text += line_of(signal, turns);
  for (const SignalDifference& signal : comparison.signals)
    if (signal.quantity == "residual")
      text += fmt::format(
          "{}  residual of joint {} alone, rms: {} in the first run, {} in the second (1 as in healthy logs)\n",
          signal.joint == 1_joint ? "\n" : "", signal.joint, value_text(signal.first_rms),
          value_text(signal.second_rms));
  const bool has_residuals =
      std::any_of(comparison.signals.begin(), comparison.signals.end(),
                  [](const SignalDifference& signal) { return signal.quantity == "residual"; });
  text +=
      "\n" + wrapped(fmt::format("Threshold: {:.3g} times the noise of both signals, estimated from their "
                                 "third differences{}; a signal diverges if three samples in a row "
                                 "exceed it.",
                                 comparison.sigmas,
                                 has_residuals ? " (of residuals at least that of healthy logs)" : ""),
                     "", kWidth);
  for (const std::string& note : comparison.notes)
    text += wrapped("Note: " + printable(note) + ".", "", kWidth);
  return text;
}

std::string to_json(const RunComparison& comparison, const std::vector<char>& turns) {
  const SignalDifference* first = comparison.first_divergence();
  const RunAlignment& alignment = comparison.alignment;
  Json signals = Json::array(), warp = Json::array();
  for (const SignalDifference& signal : comparison.signals) signals.push_back(signal_json(signal, turns));
  for (std::size_t i = 0; i < alignment.first_s.size(); ++i)
    warp.push_back(Json::array({alignment.first_s[i], alignment.second_s[i]}));
  return json_text(
      Json{{"schema", "faultline/comparison/1"},
           {"same", comparison.same()},
           {"verdict", verdict_of(comparison)},
           {"first", run_json(comparison.first, comparison.first_length_s, comparison.first_period_s)},
           {"second", run_json(comparison.second, comparison.second_length_s, comparison.second_period_s)},
           {"compared_s", comparison.compared_s},
           {"alignment",
            {{"by", kind_text(alignment)},
             {"shift_s", alignment.warped() ? Json(nullptr) : Json(alignment.shift_s)},
             {"left_rms", number_or_null(alignment.left_rms)},
             {"agreeing", alignment.agreeing},
             {"same_motion", alignment.same_motion},
             {"why", alignment.why},
             {"warp", warp}}},
           {"threshold_sigmas", comparison.sigmas},
           {"diverges_s", first ? Json(first->diverges_s) : Json(nullptr)},
           {"signals", signals},
           {"notes", comparison.notes}});
}

}  // namespace faultline
