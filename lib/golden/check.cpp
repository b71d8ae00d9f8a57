// SPDX-License-Identifier: MIT
#include "lib/golden/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "lib/core/error.hpp"

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

GoldenCheck checked(const GoldenSet& set, const GoldenRun& first, const GoldenRun& second) {
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

}  // namespace

bool GoldenCheck::same() const {
  return std::all_of(items.begin(), items.end(), [](const CheckedItem& item) { return item.same(); });
}

bool GoldenCheck::damaged() const {
  return std::any_of(items.begin(), items.end(),
                     [](const CheckedItem& item) { return !item.damage.empty(); });
}

GoldenCheck check_golden(const GoldenSet& set, const GoldenRun& run) {
  GoldenCheck check = checked(set, expected_run(set), run);
  check.expected_by = fmt::format("golden.toml (faultline {}, model {} {})", set.program_version,
                                  set.model_name, set.model.sha256.substr(0, 8));
  return check;
}

GoldenCheck compare_runs(const GoldenSet& set, const GoldenRun& first, const GoldenRun& second) {
  return checked(set, first, second);
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

}  // namespace faultline
