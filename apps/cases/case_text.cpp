// SPDX-License-Identifier: MIT
#include "apps/cases/case_text.hpp"

#include <fmt/format.h>

#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/fault/fault_words.hpp"

namespace faultline {
namespace {

/// Which log, and where in it; empty where that is not known.
std::string log_text(const Case& c) {
  if (c.log_sha256.empty()) return "";
  return fmt::format("  log      SHA-256 {}, fault from {} s on\n", printable(c.log_sha256),
                     value_text(c.onset_s));
}

}  // namespace

std::string case_line(const Case& c) {
  const std::string done = c.what_was_done.empty() ? "" : "; done: " + c.what_was_done;
  const std::string old = c.features_by.empty() ? "" : "; features of an earlier model";
  return printable(fmt::format("{:>6}  {:<12} {:<40} {}{}{}", c.id, to_string(c.outcome),
                               plain_words(c.label), c.origin, done, old)) +
         "\n";
}

std::string case_text(const CaseBase& base, const Case& c) {
  const auto opinion = [](const char* network, const Opinion& o) {
    return fmt::format("  {:<9}{} ({:.2f})\n", network, plain_words(o.label), o.confidence);
  };
  std::string text = fmt::format("Case {}: {} ({})\n", c.id, plain_words(c.label), to_string(c.outcome));
  text += fmt::format("  decided  {}\n", plain_words(c.decision));
  text += opinion("MLP", c.episode.mlp) + opinion("RBFN", c.episode.rbfn);
  text += fmt::format("  evidence {}\n  origin   {}\n{}  done     {}\n  features (value, scale, weight){}\n",
                      value_text(c.episode.evidence), printable(c.origin), log_text(c),
                      printable(c.what_was_done), c.features_by.empty() ? "" : ", of an earlier model");
  for (std::size_t i = 0; i < c.episode.features.size(); ++i) {
    const Feature& f = base.metric().features[i];
    text += fmt::format("    {:<32} {:>10} {:>10} {:>6.2f}\n", printable(f.name),
                        value_text(c.episode.features[i]), value_text(f.scale), f.weight);
  }
  return text;
}

}  // namespace faultline
