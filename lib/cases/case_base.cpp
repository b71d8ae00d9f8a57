// SPDX-License-Identifier: MIT
#include "lib/cases/case_base.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "lib/cases/possible_labels.hpp"
#include "lib/core/error.hpp"
#include "lib/core/files/inner_file.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

constexpr double kLargestNumber = 1e15;
constexpr int kMostJoints = 64;

[[noreturn]] void refuse_base(const std::string& message) {
  throw Error(ErrorCode::input, "case base", message);
}

void check_features(const std::vector<Feature>& features) {
  std::set<std::string> names;
  for (const Feature& f : features) {
    if (f.name.empty()) refuse_base("a feature has no name");
    if (!names.insert(f.name).second) refuse_base("feature \"" + f.name + "\" appears twice");
    if (!(f.scale > 0.0 && f.scale <= kLargestNumber && f.weight >= 0.0 && f.weight <= 1.0))
      refuse_base("feature \"" + f.name + "\" needs a scale above 0 and a weight of 0 to 1");
  }
}

/// Whether `x` is NaN (not measured) or a plausible measurement.
bool is_sane(double x) { return std::isnan(x) || std::abs(x) <= kLargestNumber; }

bool is_share(double x) { return x >= 0.0 && x <= 1.0; }

/// Returns the case with texts in which bytes that are not UTF-8 are replaced.
Case with_valid_texts(Case c) {
  for (std::string* text : {&c.what_was_done, &c.origin, &c.log_sha256, &c.features_by, &c.log_name, &c.robot,
                            &c.person, &c.date})
    *text = valid_utf8(*text);
  return c;
}

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

CaseBase::CaseBase(const std::vector<std::string>& feature_names) {
  for (const std::string& name : feature_names) metric_.features.push_back({.name = valid_utf8(name)});
  check_features(metric_.features);
}

CaseBase::CaseBase(Metric metric, std::vector<Case> cases)
    : metric_(std::move(metric)), cases_(std::move(cases)) {
  check_features(metric_.features);
  if (!is_share(metric_.near_similarity))
    refuse_base("the similarity from which cases are near must be from 0 to 1");
  std::int64_t last = 0;
  for (Case& c : cases_) {
    if (c.id <= last)
      refuse_base("case ids must be above 0 and increase; " + std::to_string(c.id) + " does not");
    last = c.id;
    check(c);
    c = with_valid_texts(std::move(c));
  }
}

std::vector<std::string> CaseBase::feature_names() const {
  std::vector<std::string> names;
  for (const Feature& f : metric_.features) names.push_back(f.name);
  return names;
}

void CaseBase::check(const Case& c) const {
  const std::string which = "case " + std::to_string(c.id);
  if (c.episode.features.size() != metric_.features.size())
    refuse_base(which + " has " + std::to_string(c.episode.features.size()) +
                " features, this base compares " + std::to_string(metric_.features.size()) +
                "; it comes from another robot or program version");
  for (std::size_t i = 0; i < metric_.features.size(); ++i)
    if (!is_sane(c.episode.features[i]))
      refuse_base(which + ": feature \"" + metric_.features[i].name +
                  "\" is infinite or beyond any measurement");
  if (!is_share(c.episode.mlp.confidence) || !is_share(c.episode.rbfn.confidence))
    refuse_base(which + ": the confidence of an opinion must be 0 to 1");
  if (!is_sane(c.episode.evidence))
    refuse_base(which + ": the evidence is infinite or beyond any measurement");
  if (!is_sane(c.onset_s)) refuse_base(which + ": the onset is infinite or beyond any measurement");
  if (!c.log_name.empty() && (!is_plain_log_name(c.log_name) || c.log_name.find('/') != std::string::npos))
    refuse_base(which + ": \"" + c.log_name +
                "\" is not the name of a log; give the name of the file, without folders");
  for (const FaultLabel& label : {c.decision, c.label, c.episode.mlp.label, c.episode.rbfn.label})
    if (label.joint.number() < 0 || label.joint.number() > kMostJoints)
      refuse_base(which + ": joints count from 1, to " + std::to_string(kMostJoints) + " at most");
}

const Case& CaseBase::at(std::int64_t id) const {
  const auto found = std::lower_bound(cases_.begin(), cases_.end(), id,
                                      [](const Case& c, std::int64_t wanted) { return c.id < wanted; });
  if (found == cases_.end() || found->id != id)
    throw Error(
        ErrorCode::usage, "case " + std::to_string(id),
        "does not exist; `faultline cases list` shows all " + std::to_string(cases_.size()) + " cases");
  return *found;
}

Case& CaseBase::find(std::int64_t id) { return const_cast<Case&>(at(id)); }

void CaseBase::take(Case c) {
  check(c);
  cases_.push_back(with_valid_texts(std::move(c)));
}

std::int64_t CaseBase::retain(Case c) {
  c.id = cases_.empty() ? 1 : cases_.back().id + 1;
  take(std::move(c));
  return cases_.back().id;
}

std::int64_t CaseBase::retain_with_id(Case c) {
  if (c.id <= (cases_.empty() ? 0 : cases_.back().id)) return retain(std::move(c));
  take(std::move(c));
  return cases_.back().id;
}

void CaseBase::revise(Case& c, CaseOutcome outcome, const FaultLabel& label, const std::string& what_was_done,
                      const Signature& signature) {
  const bool says_another = c.outcome != outcome || c.label != label;
  if (says_another || !signature.person.empty()) c.person = valid_utf8(signature.person);
  if (says_another || !signature.date.empty()) c.date = valid_utf8(signature.date);
  c.outcome = outcome;
  c.label = label;
  if (!what_was_done.empty()) c.what_was_done = valid_utf8(what_was_done);
}

void CaseBase::confirm(std::int64_t id, std::optional<FaultLabel> label, const std::string& what_was_done,
                       const Signature& signature) {
  Case& c = find(id);
  revise(c, CaseOutcome::confirmed, label.value_or(c.decision), what_was_done, signature);
}

void CaseBase::reject(std::int64_t id, std::optional<FaultLabel> was, const std::string& what_was_done,
                      const Signature& signature) {
  revise(find(id), CaseOutcome::rejected, was.value_or(FaultLabel{FaultKind::unknown}), what_was_done,
         signature);
}

void CaseBase::replace(Case c) {
  Case& there = find(c.id);
  check(c);
  there = with_valid_texts(std::move(c));
}

void CaseBase::remove(std::int64_t id) { cases_.erase(cases_.begin() + (&at(id) - cases_.data())); }

void CaseBase::describe_robot(const CaseRobot& robot) {
  robot_ = {valid_utf8(robot.name), valid_utf8(robot.axes)};
}

void CaseBase::belong_to(const std::string& model_identity) {
  const bool moves = !model_identity_.empty() && model_identity != model_identity_;
  for (Case& c : cases_)
    if (c.features_by.empty() && moves)
      c.features_by = model_identity_;
    else if (c.features_by == model_identity)
      c.features_by.clear();
  model_identity_ = model_identity;
}

void CaseBase::learn() {
  std::vector<Case> known;
  std::copy_if(cases_.begin(), cases_.end(), std::back_inserter(known), fault_is_known);
  metric_ = learn_metric(metric_.features, known);
}

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
