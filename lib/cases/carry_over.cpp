// SPDX-License-Identifier: MIT
#include "lib/cases/carry_over.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace faultline {
namespace {

bool is_revised(const Case& c) {
  return c.outcome != CaseOutcome::confirmed || !(c.label == c.decision) || !c.what_was_done.empty() ||
         !c.person.empty() || !c.date.empty();
}

/// Returns the case that `learn` made of the same fault of the same log; null if there is none.
const Case* twin_of(const Case& c, const CaseBase& fresh) {
  if (c.log_sha256.empty()) return nullptr;  // simulated, or recorded by hand
  const auto& cases = fresh.cases();
  const auto found = std::find_if(cases.begin(), cases.end(), [&](const Case& other) {
    return other.origin == kLabelledOrigin && other.decision == c.label && other.log_sha256 == c.log_sha256;
  });
  return found == cases.end() ? nullptr : &*found;
}

/// Returns the features of a case of `old` in the order of `fresh`; NaN if `old` lacks a feature.
std::vector<double> moved_features(const Case& c, const CaseBase& old, const CaseBase& fresh) {
  std::map<std::string, double> by_name;
  for (std::size_t i = 0; i < c.episode.features.size(); ++i)
    by_name[old.metric().features[i].name] = c.episode.features[i];
  std::vector<double> moved;
  for (const Feature& feature : fresh.metric().features) {
    const auto known = by_name.find(feature.name);
    moved.push_back(known == by_name.end() ? std::numeric_limits<double>::quiet_NaN() : known->second);
  }
  return moved;
}

/// Returns `fresh` without the cases that a case added or revised by people replaces.
CaseBase without_superseded(const CaseBase& old, const CaseBase& fresh) {
  std::set<std::int64_t> superseded;
  for (const Case& c : old.cases())
    if (const Case* twin = is_made_by_learn(c) ? nullptr : twin_of(c, fresh)) superseded.insert(twin->id);
  std::vector<Case> cases = fresh.cases();
  std::erase_if(cases, [&](const Case& c) { return superseded.count(c.id) > 0; });
  CaseBase rest(fresh.metric(), std::move(cases));
  rest.belong_to(fresh.model_identity());
  rest.describe_robot(fresh.robot());
  return rest;
}

}  // namespace

bool is_made_by_learn(const Case& c) {
  return (c.origin == kSimulatedOrigin || c.origin == kLabelledOrigin) && !is_revised(c);
}

CarriedCases carry_over(const CaseBase& old, CaseBase& fresh) {
  const CaseBase learned = fresh;
  fresh = without_superseded(old, learned);
  CarriedCases count;
  for (Case c : old.cases()) {
    const Case* twin = twin_of(c, learned);
    if (is_made_by_learn(c) && (c.origin == kSimulatedOrigin || twin)) {
      ++count.replaced;
      continue;
    }
    if (twin) {
      c.episode = twin->episode;
      c.features_by.clear();
      c.log_name = twin->log_name;
      ++count.recomputed;
    } else {
      c.episode.features = moved_features(c, old, learned);
      if (c.features_by.empty() && old.model_identity() != learned.model_identity())
        c.features_by = old.model_identity();
      if (!c.features_by.empty()) ++count.old_features;
    }
    const std::int64_t id = c.id;
    if (fresh.retain_with_id(std::move(c)) != id) ++count.renumbered;
    ++count.carried;
  }
  return count;
}

}  // namespace faultline
