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

CheckedItem checked(const std::string& name, const Observation& expected, const Observation& actual,
                    const ToleranceChain& chain) {
  CheckedItem item{name,
                   "",
                   expected.verdict,
                   actual.verdict,
                   static_cast<int>(expected.events.size()),
                   static_cast<int>(actual.events.size()),
                   compare(expected, actual, chain)};
  return item;
}

CheckedItem checked(const ObservedIdentification& expected, const ObservedIdentification& actual,
                    const ToleranceChain& chain) {
  return {kIdentification, "", expected.status, actual.status, 0, 0, compare(expected, actual, chain)};
}

/// The model compared; nothing where one side has no values.
std::optional<CheckedItem> checked_model(const std::vector<ParameterValue>& expected,
                                         const std::vector<ParameterValue>& actual, const GoldenSet& set) {
  if (expected.empty() || actual.empty()) return std::nullopt;
  return CheckedItem{kModelItem, "", "", "", 0, 0, compare(expected, actual, set.chain())};
}

/// One log compared, unless its golden files are damaged.
CheckedItem checked_log(const GoldenSet& set, const GoldenLog& log, const Observation& expected,
                        const Observation& actual) {
  CheckedItem item = checked(log.name(), expected, actual, set.chain(log));
  if (log.damage.empty()) return item;
  item.damage = log.damage;
  item.comparison = {};
  return item;
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
  GoldenCheck check;
  check.expected_by = fmt::format("golden.toml (faultline {}, model {} {})", set.program_version,
                                  set.model_name, set.model.sha256.substr(0, 8));
  check.actual_by = said_by(run);
  for (const GoldenLog& log : set.logs)
    check.items.push_back(checked_log(set, log, log.expected, observation_of(run, log.name())));
  if (set.identification)
    check.items.push_back(checked(set.identification->expected, identification_of(run.identification),
                                  set.chain(*set.identification)));
  if (std::optional<CheckedItem> model = checked_model(set.model_values, run.model_values, set))
    check.items.push_back(std::move(*model));
  return check;
}

GoldenCheck compare_runs(const GoldenSet& set, const GoldenRun& first, const GoldenRun& second) {
  GoldenCheck check;
  check.expected_by = said_by(first);
  check.actual_by = said_by(second);
  for (const GoldenLog& log : set.logs)
    check.items.push_back(
        checked_log(set, log, observation_of(first, log.name()), observation_of(second, log.name())));
  if (set.identification)
    check.items.push_back(checked(identification_of(first.identification),
                                  identification_of(second.identification), set.chain(*set.identification)));
  if (std::optional<CheckedItem> model = checked_model(first.model_values, second.model_values, set))
    check.items.push_back(std::move(*model));
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

}  // namespace faultline
