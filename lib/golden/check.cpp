// SPDX-License-Identifier: MIT
#include "lib/golden/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lib/core/error.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/report/text.hpp"

namespace faultline {
namespace {

std::string said_by(const GoldenRun& run) {
  return fmt::format("faultline {}, model {} {}", run.program_version, run.model.name,
                     run.model.sha256.substr(0, 8));
}

const Observation& observation_of(const GoldenRun& run, const std::string& name) {
  for (const GoldenRun::Log& log : run.logs)
    if (log.name == name) return log.observation;
  throw Error(ErrorCode::input, said_by(run), "does not have the log " + name + " of this golden folder");
}

/// An identification that was not made is one of status "not_run".
ObservedIdentification identification_of(const std::optional<ObservedIdentification>& identification) {
  return identification ? *identification : ObservedIdentification{"not_run", "", {}, ""};
}

/// One log compared, unless its golden files are damaged.
CheckedItem checked_log(const GoldenSet& set, const GoldenLog& log, const Observation& expected,
                        const Observation& actual) {
  CheckedItem item{log.name(),
                   log.damage,
                   expected.verdict,
                   actual.verdict,
                   static_cast<int>(expected.events.size()),
                   static_cast<int>(actual.events.size()),
                   {}};
  if (log.damage.empty()) item.comparison = compare(expected, actual, set.chain(log));
  return item;
}

/// What the set expects, as a run that says so.
GoldenRun expected_run(const GoldenSet& set) {
  GoldenRun run;
  run.model_values = set.model_values;
  for (const GoldenLog& log : set.logs) run.logs.push_back({log.name(), log.expected});
  if (set.identification) run.identification = set.identification->expected;
  return run;
}

std::string result_word(const CheckedItem& item) {
  if (!item.damage.empty()) return "DAMAGED";
  if (item.same()) return "same";
  return fmt::format("{} differ{}", item.comparison.differences.size(),
                     item.changes_verdict() ? ", also in the findings" : "");
}

std::string change(const std::string& expected, const std::string& actual) {
  return expected == actual ? expected : expected + " -> " + actual;
}

std::string cell(const std::string& text, std::size_t width) {
  return text + std::string(width > text.size() ? width - text.size() : 0, ' ');
}

std::string table(const GoldenCheck& check, bool color) {
  std::size_t name = 3, verdict = 7;
  for (const CheckedItem& item : check.items) {
    name = std::max(name, printable(item.name).size());
    verdict = std::max(verdict, change(item.verdict_expected, item.verdict_actual).size());
  }
  std::string text =
      cell("log", name) + "  " + cell("verdict", verdict) + "  " + cell("events", 8) + "result\n";
  for (const CheckedItem& item : check.items) {
    const bool is_log = item.name != kIdentification && item.name != kModelItem;
    const std::string events =
        is_log ? change(fmt::format("{}", item.events_expected), fmt::format("{}", item.events_actual)) : "";
    text += cell(printable(item.name), name) + "  " +
            cell(item.damage.empty() ? change(item.verdict_expected, item.verdict_actual) : "-", verdict) +
            "  " + cell(item.damage.empty() ? events : "-", 8) +
            painted(result_word(item), item.same() ? Paint::bold_green : Paint::bold_red, color) + "\n";
  }
  return text;
}

std::string summary(const GoldenCheck& check) {
  const auto count = [&](auto&& which) {
    return std::count_if(check.items.begin(), check.items.end(), which);
  };
  const auto damaged = count([](const CheckedItem& i) { return !i.damage.empty(); });
  const auto same = count([](const CheckedItem& i) { return i.same(); });
  const auto different = std::ssize(check.items) - same - damaged;
  const auto found = count([](const CheckedItem& i) { return i.changes_verdict(); });
  const std::string where = different == 0 ? "" : fmt::format(" ({} also in the findings)", found);
  return fmt::format("{} of {} as expected, {} different{}, {} damaged.\n", same, check.items.size(),
                     different, where, damaged);
}

/// "first divergence at 3.204 s: dq2 is 0.412, expected 0.398 (allowed 0.003)"; empty when nothing differs.
std::string divergence_text(const CheckedItem& item) {
  const Difference* first = first_divergence(item.comparison);
  if (!first) return "";
  std::string text = "first divergence";
  if (!std::isnan(first->time_s)) text += " at " + seconds_text(first->time_s);
  text += fmt::format(": {} is {}, expected {}", first->channel,
                      first->actual.empty() ? "missing" : printable(first->actual),
                      first->expected.empty() ? "none" : printable(first->expected));
  if (!std::isnan(first->allowed) && first->channel != "rows")
    text += fmt::format(" (allowed +-{:.3g})", first->allowed);
  return text;
}

/// Lines of - expected and + actual among those that agree.
std::string unified_difference(const CheckedItem& item, const GoldenCheck& check, bool color = false) {
  std::string text =
      painted(fmt::format("--- {}: expected by {}", printable(item.name), printable(check.expected_by)),
              Paint::bold, color) +
      "\n" +
      painted(fmt::format("+++ {}: {}", printable(item.name), printable(check.actual_by)), Paint::bold,
              color) +
      "\n";
  for (const DiffLine& line : item.comparison.lines) {
    if (!line.differs) {
      text += "  " + printable(line.expected) + "\n";
      continue;
    }
    if (!line.expected.empty())
      text += painted("- " + printable(line.expected), Paint::bold_red, color) + "\n";
    if (!line.actual.empty()) text += painted("+ " + printable(line.actual), Paint::bold_green, color) + "\n";
  }
  return text;
}

std::string junit_body(const CheckedItem& item, const GoldenCheck& check) {
  if (!item.damage.empty())
    return fmt::format("      <error type=\"damaged\" message=\"{}\"/>\n", escaped_markup(item.damage));
  if (item.same()) return "";
  return fmt::format("      <failure type=\"{}\" message=\"{}\">{}</failure>\n",
                     item.changes_verdict() ? "verdict" : "mismatch", escaped_markup(divergence_text(item)),
                     escaped_markup(unified_difference(item, check)));
}

}  // namespace

bool GoldenCheck::same() const {
  return std::all_of(items.begin(), items.end(), [](const CheckedItem& item) { return item.same(); });
}

bool GoldenCheck::damaged() const {
  return std::any_of(items.begin(), items.end(),
                     [](const CheckedItem& item) { return !item.damage.empty(); });
}

GoldenCheck compare_runs(const GoldenSet& set, const GoldenRun& first, const GoldenRun& second) {
  GoldenCheck check{said_by(first), said_by(second), {}};
  for (const GoldenLog& log : set.logs)
    check.items.push_back(
        checked_log(set, log, observation_of(first, log.name()), observation_of(second, log.name())));
  if (set.identification) {
    const ObservedIdentification expected = identification_of(first.identification),
                                 actual = identification_of(second.identification);
    check.items.push_back({kIdentification, "", expected.status, actual.status, 0, 0,
                           compare(expected, actual, set.chain(*set.identification))});
  }
  if (!first.model_values.empty() && !second.model_values.empty())
    check.items.push_back(
        {kModelItem, "", "", "", 0, 0, compare(first.model_values, second.model_values, set.chain())});
  return check;
}

GoldenCheck check_golden(const GoldenSet& set, const GoldenRun& run) {
  GoldenCheck check = compare_runs(set, expected_run(set), run);
  check.expected_by = fmt::format("golden.toml (faultline {}, model {} {})", set.program_version,
                                  set.model_name, set.model.sha256.substr(0, 8));
  return check;
}

GoldenSet with_actual(GoldenSet set, const GoldenRun& run, const std::string& name) {
  set.program_version = run.program_version;
  if (name == kIdentification) {
    if (set.identification && run.identification) set.identification->expected = *run.identification;
    return set;
  }
  if (name == kModelItem) {
    set.model_values = run.model_values;
    return set;
  }
  for (GoldenLog& log : set.logs) {
    if (log.name() != name) continue;
    log.expected = observation_of(run, name);
    log.damage.clear();
  }
  return set;
}

std::string render_check_text(const GoldenCheck& check, bool color) {
  std::string text = table(check, color);
  for (const CheckedItem& item : check.items) {
    if (item.same()) continue;
    text += "\n" + painted(printable(item.name), Paint::bold, color) + ": ";
    if (!item.damage.empty())
      text += printable(item.damage) + "\n";
    else
      text += divergence_text(item) + "\n" + unified_difference(item, check, color);
  }
  return text + "\n" + summary(check);
}

std::string render_check_junit(const GoldenCheck& check, const std::string& suite) {
  std::vector<JunitCase> cases;
  for (const CheckedItem& item : check.items) cases.push_back({item.name, junit_body(item, check)});
  return junit_suite(suite, cases, {"errors"});
}

}  // namespace faultline
