// SPDX-License-Identifier: MIT
// CaseBase::merge(): adds cases of another base of the same kind of robot.
#include <algorithm>
#include <cmath>
#include <set>

#include "lib/cases/case_base.hpp"
#include "lib/cases/possible_labels.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

constexpr double kOneOnset_s = 0.1;  // another model may estimate another onset of the same fault

bool same_time(double a_s, double b_s) {
  return std::isnan(a_s) || std::isnan(b_s) ? std::isnan(a_s) == std::isnan(b_s)
                                            : std::abs(a_s - b_s) <= kOneOnset_s;
}

void check_kind(const CaseBase& base, const CaseBase& other) {
  const std::string &axes = base.robot().axes, &others = other.robot().axes;
  if (axes != others)
    throw Error(ErrorCode::usage, "case base",
                "the cases to be added are of a robot with the axes " + others + ", those here of one with " +
                    axes + "; only cases of the same kind of robot can be compared");
  if (base.feature_names() != other.feature_names())
    throw Error(ErrorCode::input, "case base",
                "the cases to be added have other features; they come from another robot, another meaning of "
                "its torque or another program version");
}

/// Whether a person has judged `c`, and later than `there`.
bool says_more(const Case& c, const Case& there) {
  if (c.outcome == CaseOutcome::unconfirmed) return false;
  if (there.outcome == CaseOutcome::unconfirmed) return true;
  return c.date > there.date &&
         (c.outcome != there.outcome || c.label != there.label || c.what_was_done != there.what_was_done);
}

/// Returns a key that is equal for cases that differ only in their id or in naming the base's own robot.
std::string key_of(Case c, const CaseRobot& robot) {
  if (c.robot == robot.name) c.robot.clear();
  return content_hash(c);
}

/// Returns `there` with outcome, label and signature of `c`, a case of the same event.
Case with_word_of(const Case& c, Case there) {
  there.outcome = c.outcome;
  there.label = c.label;
  there.person = c.person;
  there.date = c.date;
  if (!c.what_was_done.empty()) there.what_was_done = c.what_was_done;
  return there;
}

}  // namespace

bool is_same_event(const Case& a, const Case& b) {
  return !a.log_sha256.empty() && a.log_sha256 == b.log_sha256 && same_time(a.onset_s, b.onset_s) &&
         (a.decision == b.decision || a.label == b.label);
}

const Case* find_same_event(const CaseBase& base, const Case& c) {
  const auto& cases = base.cases();
  const auto found =
      std::find_if(cases.begin(), cases.end(), [&](const Case& other) { return is_same_event(other, c); });
  return found == cases.end() ? nullptr : &*found;
}

MergedCases CaseBase::merge(const CaseBase& other) {
  check_kind(*this, other);
  for (const Case& c : other.cases()) check_joint(joints_of(*this), c.label, "case " + std::to_string(c.id));
  std::set<std::string> present;
  for (const Case& c : cases_) present.insert(key_of(c, robot_));
  CaseBase marked = other;
  marked.belong_to(model_identity_);
  MergedCases merged;
  for (Case c : marked.cases()) {
    if (c.robot.empty()) c.robot = other.robot().name;
    if (!is_of_field(c) && c.robot == robot_.name) c.robot.clear();
    if (!present.insert(key_of(c, robot_)).second) continue;
    if (const Case* there = find_same_event(*this, c)) {
      if (!says_more(c, *there)) continue;
      replace(with_word_of(c, *there));
      ++merged.updated;
    } else {
      retain(std::move(c));
      ++merged.added;
    }
  }
  return merged;
}

}  // namespace faultline
