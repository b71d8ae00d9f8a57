// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>

#include "apps/suggestion/robot_guess.hpp"
#include "lib/core/text.hpp"
#include "lib/log/column_matching.hpp"
#include "lib/robot/toml/toml_values.hpp"

namespace faultline {
namespace {

/// Returns a comment of any length, shortened, in one line.
std::string comment(const std::string& text) { return "# " + brief(text) + "\n"; }

std::string channel_text(const GuessedChannel& one, const RawExcerpt& excerpt) {
  const std::string name = one.column >= 0 ? excerpt.columns[one.column].name : kRowNumberName;
  std::string spec = "name = " + toml_quoted(valid_utf8(name));
  if (!one.spec.unit.empty()) spec += ", unit = " + toml_quoted(one.spec.unit);
  if (one.spec.sign != 1.0) spec += ", sign = -1";
  if (one.spec.scale != 1.0) spec += ", scale = " + toml_number(one.spec.scale);
  return comment(to_string(one.channel) + ": " + one.reason) +
         fmt::format("{} = {{{}}}\n", to_string(one.channel), spec);
}

}  // namespace

std::string robot_guess_text(const RobotGuess& guess, const RawExcerpt& excerpt) {
  const std::string stem = std::filesystem::path(excerpt.path).stem().string();
  std::string text =
      comment(fmt::format("Suggested by faultline inspect from the first {} rows of {}.", excerpt.rows(),
                          std::filesystem::path(excerpt.path).filename().string()));
  text += "# Each guess has its reason above it; look at those that begin with \"?\".\n";
  for (const std::string& what : guess.untold) text += comment("Not determined: " + what);
  text +=
      "# Not determined: masses, lengths, the direction of gravity, and whether the joints are in this "
      "order.\n\n";
  text += "name = " + toml_quoted(valid_utf8(stem)) + "\n";
  std::string axes;
  for (int j = 0; j < std::ssize(guess.axes); ++j) {
    text += comment(fmt::format("joint {} {}: {}", Joint::at(j), guess.axes[j].slides ? "slides" : "turns",
                                guess.axes[j].reason));
    axes += guess.axes[j].slides ? 'P' : 'R';
  }
  text += fmt::format("axes = \"{}\"\n\n[log]\n", axes);
  if (!guess.torque_reason.empty())
    text += comment("torque: " + guess.torque_reason) + fmt::format("torque = \"{}\"\n", guess.torque);
  if (excerpt.canonical)
    return text + "# The columns are channels in SI units: the file defines what they are.\n";
  text += "\n[log.columns]\n";
  for (const GuessedChannel& one : guess.channels) {
    if (one.nanoseconds < 0)
      text += channel_text(one, excerpt);
    else
      text += comment("t: seconds and nanoseconds, found by their names");
  }
  return text;
}

}  // namespace faultline
