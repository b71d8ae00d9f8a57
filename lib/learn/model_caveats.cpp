// SPDX-License-Identifier: MIT
#include "lib/learn/model_caveats.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lib/core/error.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

// Shares of simulated faults. Models of laboratory arms, whose torque a rigid robot explains to 90 %, find 45
// to 75 %, those of robots that equal their model 98 %.
constexpr double kBlind = 1.0 / 3.0;  // found: below it, the absence of findings has no meaning
constexpr double kUsual = 0.8;        // found: below it, a minor doubt
constexpr double kNamed = 0.6;        // named right or as an alternative: below it, a minor doubt

void doubt_friction(const ParameterEstimate& parameter, ModelCaveats& doubts) {
  const bool viscous = parameter.name.rfind("fv_", 0) == 0, coulomb = parameter.name.rfind("fc_", 0) == 0;
  if ((viscous || coulomb) && parameter.identifiable && parameter.ci95[1] < 0.0)
    doubts.minor.push_back(
        fmt::format("the {} friction {} was estimated as negative, {:.3g} {}, and is treated as zero",
                    viscous ? "viscous" : "Coulomb", parameter.name, parameter.value, parameter.unit));
}

}  // namespace

void ModelCaveats::add(const ModelCaveats& more) {
  grave.insert(grave.end(), more.grave.begin(), more.grave.end());
  contradictions.insert(contradictions.end(), more.contradictions.begin(), more.contradictions.end());
  minor.insert(minor.end(), more.minor.begin(), more.minor.end());
}

ModelCaveats caveats_of(const Identification& identification) {
  ModelCaveats doubts;
  if (identification.status == IdentificationStatus::unexplained)
    doubts.grave.push_back("the robot does not explain the logs: " + identification.reason);
  if (identification.status == IdentificationStatus::poorly_explained)
    doubts.minor.push_back("the robot explains the logs poorly: " + identification.reason);
  if (identification.status == IdentificationStatus::not_converged)
    doubts.minor.push_back("the identification did not converge: " + identification.reason);
  for (const ParameterEstimate& parameter : identification.base_parameters) doubt_friction(parameter, doubts);
  return doubts;
}

ModelCaveats caveats_of(const Validation& validation, bool has_relations) {
  ModelCaveats doubts;
  int runs = 0, found = 0, named = 0;
  for (const ValidationRow& row : validation.rows) {
    runs += row.runs;
    found += row.detected;
    named += row.right_or_named;
  }
  if (runs > 0 && found < kBlind * runs)
    (has_relations ? doubts.minor : doubts.grave)
        .push_back(fmt::format("it finds only {} of {} simulated faults", found, runs));
  else if (found < kUsual * runs)
    doubts.minor.push_back(fmt::format("it misses {} of {} simulated faults", runs - found, runs));
  if (found >= kBlind * runs && named < kNamed * runs)
    doubts.minor.push_back(fmt::format("it names only {} of {} simulated faults correctly", named, runs));
  if (validation.false_alarms > 1)  // a single one in all simulated healthy runs is by chance
    doubts.minor.push_back(fmt::format("it raises {} in {:.2f} h of simulated healthy running",
                                       counted(validation.false_alarms, "false alarm"),
                                       validation.healthy_hours));
  return doubts;
}

std::vector<std::string> against_healthy(const ModelCaveats& doubts) {
  std::vector<std::string> all = doubts.grave;
  all.insert(all.end(), doubts.contradictions.begin(), doubts.contradictions.end());
  return all;
}

std::vector<std::string> listed(const ModelCaveats& doubts) {
  std::vector<std::string> all = against_healthy(doubts);
  all.insert(all.end(), doubts.minor.begin(), doubts.minor.end());
  return all;
}

void refuse_grave(const ModelCaveats& doubts) {
  if (!doubts.is_grave()) return;
  throw Error(
      ErrorCode::input, "the healthy logs",
      fmt::format("do not give a reliable model: {}. Leave out logs that are not healthy or do not match the "
                  "robot file; --force learns a model nevertheless and marks it as doubtful",
                  fmt::join(doubts.grave, "; ")));
}

}  // namespace faultline
