// SPDX-License-Identifier: MIT
#include "apps/cases/case_text.hpp"

#include <fmt/format.h>

#include "lib/cases/case_origin.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/fault/fault_words.hpp"

namespace faultline {
namespace {

std::string row(const char* name, const std::string& text) {
  return text.empty() ? "" : fmt::format("  {:<9}{}\n", name, printable(text));
}

/// Where it was seen and who says what it was, as far as that is known.
std::string source_rows(const CaseBase& base, const Case& c) {
  const std::string& robot = c.robot.empty() ? base.robot().name : c.robot;
  std::string text = row("origin", origin_words(c, base.robot().name)) + row("robot", robot) +
                     row("person", c.person) + row("date", c.date);
  if (c.log_sha256.empty()) return text + row("log", log_name_of(c));
  const std::string name = log_name_of(c);
  return text + row("log", fmt::format("{}SHA-256 {}, fault from {} s on", name.empty() ? "" : name + ", ",
                                       c.log_sha256, value_text(c.onset_s)));
}

}  // namespace

std::string case_line(const CaseBase& base, const Case& c) {
  const std::string done = c.what_was_done.empty() ? "" : "; done: " + c.what_was_done;
  return printable(fmt::format("{:>6}  {:<12} {:<40} {}{}", c.id, to_string(c.outcome), plain_words(c.label),
                               origin_words(c, base.robot().name), done)) +
         "\n";
}

std::string case_text(const CaseBase& base, const Case& c) {
  const auto opinion = [](const char* network, const Opinion& o) {
    return fmt::format("  {:<9}{} ({:.2f})\n", network, plain_words(o.label), o.confidence);
  };
  std::string text = fmt::format("Case {}: {} ({})\n", c.id, plain_words(c.label), to_string(c.outcome));
  text += fmt::format("  decided  {}\n", plain_words(c.decision));
  text += opinion("MLP", c.episode.mlp) + opinion("RBFN", c.episode.rbfn);
  text += row("evidence", value_text(c.episode.evidence)) + source_rows(base, c) +
          fmt::format("  done     {}\n", printable(c.what_was_done));
  text +=
      fmt::format("  features (value, scale, weight){}\n", c.features_by.empty() ? "" : ", of another model");
  for (std::size_t i = 0; i < c.episode.features.size(); ++i) {
    const Feature& f = base.metric().features[i];
    text += fmt::format("    {:<32} {:>10} {:>10} {:>6.2f}\n", printable(f.name),
                        value_text(c.episode.features[i]), value_text(f.scale), f.weight);
  }
  return text;
}

}  // namespace faultline
