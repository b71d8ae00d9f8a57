// SPDX-License-Identifier: MIT
#include "lib/cases/case_base.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "lib/core/utf8.hpp"

namespace faultline {
namespace {

constexpr double kLargestNumber = 1e15;
constexpr int kMostJoints = 64;

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorCode::input, "case base", message); }

void check_features(const std::vector<Feature>& features) {
  std::set<std::string> names;
  for (const Feature& f : features) {
    if (f.name.empty()) refuse("a feature has no name");
    if (!names.insert(f.name).second) refuse("feature \"" + f.name + "\" is there twice");
    if (!(f.scale > 0.0 && f.scale <= kLargestNumber && f.weight >= 0.0 && f.weight <= 1.0))
      refuse("feature \"" + f.name + "\" needs a scale above 0 and a weight of 0 to 1");
  }
}

/// NaN, which is not measured, or a number that something measured may have.
bool is_sane(double x) { return std::isnan(x) || std::abs(x) <= kLargestNumber; }

bool is_share(double x) { return x >= 0.0 && x <= 1.0; }

bool is_known(const Case& c) {
  return !(c.outcome == CaseOutcome::rejected && c.label.kind == FaultKind::unknown);
}

/// Numbers and texts in one unambiguous order of bytes.
class ContentHash {
 public:
  void add(const std::string& text) {
    add_bits(text.size());
    hash_.update(text);
  }
  void add(double x) { add_bits(std::bit_cast<std::uint64_t>(std::isnan(x) ? std::nan("") : x + 0.0)); }
  void add(const FaultLabel& label) {
    add(std::string(to_string(label.kind)));
    add_bits(static_cast<std::uint64_t>(label.joint));
  }
  void add(const Opinion& opinion) {
    add(opinion.label);
    add(opinion.confidence);
  }
  void add_bits(std::uint64_t bits) {
    char bytes[8];
    for (char& byte : bytes) {
      byte = static_cast<char>(bits & 0xff);
      bits >>= 8;
    }
    hash_.update({bytes, 8});
  }
  std::string hex() const { return hash_.hex(); }

 private:
  Sha256 hash_;
};

/// Bases without any of these keep the hash that they had before cases knew them.
bool tells_of_its_log(const Case& c) {
  return !c.log_sha256.empty() || !std::isnan(c.onset_s) || !c.features_by.empty();
}

void add_log(ContentHash& hash, const Case& c) {
  hash.add(c.log_sha256);
  hash.add(c.onset_s);
  hash.add(c.features_by);
}

void add_content(ContentHash& hash, const Case& c) {
  for (const double x : c.episode.features) hash.add(x);
  hash.add(c.episode.mlp);
  hash.add(c.episode.rbfn);
  hash.add(c.episode.evidence);
  hash.add(c.decision);
  hash.add(c.label);
  hash.add(std::string(to_string(c.outcome)));
  hash.add(c.what_was_done);
  hash.add(c.origin);
}

void mend_texts(Case& c) {
  for (std::string* text : {&c.what_was_done, &c.origin, &c.log_sha256, &c.features_by})
    *text = valid_utf8(*text);
}

/// All of a case but its id.
std::string content_of(const Case& c) {
  ContentHash hash;
  add_content(hash, c);
  add_log(hash, c);
  return hash.hex();
}

}  // namespace

CaseBase::CaseBase(const std::vector<std::string>& feature_names) {
  for (const std::string& name : feature_names) metric_.features.push_back({.name = valid_utf8(name)});
  check_features(metric_.features);
}

CaseBase::CaseBase(Metric metric, std::vector<Case> cases)
    : metric_(std::move(metric)), cases_(std::move(cases)) {
  check_features(metric_.features);
  if (!is_share(metric_.near_similarity)) refuse("the similarity that counts as near must be 0 to 1");
  std::int64_t last = 0;
  for (Case& c : cases_) {
    if (c.id <= last) refuse("case ids must be above 0 and ascend; " + std::to_string(c.id) + " does not");
    last = c.id;
    check(c);
    mend_texts(c);
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
    refuse(which + " has " + std::to_string(c.episode.features.size()) + " features, this base compares " +
           std::to_string(metric_.features.size()) + "; it comes from another robot or program version");
  for (std::size_t i = 0; i < metric_.features.size(); ++i)
    if (!is_sane(c.episode.features[i]))
      refuse(which + ": feature \"" + metric_.features[i].name + "\" is infinite or beyond any measurement");
  if (!is_share(c.episode.mlp.confidence) || !is_share(c.episode.rbfn.confidence))
    refuse(which + ": the confidence of an opinion must be 0 to 1");
  if (!is_sane(c.episode.evidence)) refuse(which + ": the evidence is infinite or beyond any measurement");
  if (!is_sane(c.onset_s)) refuse(which + ": the onset is infinite or beyond any measurement");
  for (const FaultLabel& label : {c.decision, c.label, c.episode.mlp.label, c.episode.rbfn.label})
    if (label.joint < 0 || label.joint > kMostJoints)
      refuse(which + ": joints count from 1, to " + std::to_string(kMostJoints) + " at most");
}

const Case& CaseBase::at(std::int64_t id) const {
  const auto found = std::lower_bound(cases_.begin(), cases_.end(), id,
                                      [](const Case& c, std::int64_t wanted) { return c.id < wanted; });
  if (found == cases_.end() || found->id != id)
    throw Error(ErrorCode::usage, "case " + std::to_string(id),
                "there is no such case; `faultline cases list` shows the " + std::to_string(cases_.size()) +
                    " there are");
  return *found;
}

Case& CaseBase::find(std::int64_t id) { return const_cast<Case&>(at(id)); }

void CaseBase::take(Case c) {
  check(c);
  mend_texts(c);
  cases_.push_back(std::move(c));
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

void CaseBase::confirm(std::int64_t id, std::optional<FaultLabel> label, const std::string& what_was_done) {
  Case& c = find(id);
  c.outcome = CaseOutcome::confirmed;
  c.label = label.value_or(c.decision);
  if (!what_was_done.empty()) c.what_was_done = valid_utf8(what_was_done);
}

void CaseBase::reject(std::int64_t id, std::optional<FaultLabel> was, const std::string& what_was_done) {
  Case& c = find(id);
  c.outcome = CaseOutcome::rejected;
  c.label = was.value_or(FaultLabel{FaultKind::unknown, 0});
  if (!what_was_done.empty()) c.what_was_done = valid_utf8(what_was_done);
}

void CaseBase::belong_to(const std::string& model_identity) {
  if (!model_identity_.empty() && model_identity != model_identity_)
    for (Case& c : cases_)
      if (c.features_by.empty()) c.features_by = model_identity_;
  model_identity_ = model_identity;
}

std::int64_t CaseBase::merge(const CaseBase& other) {
  if (feature_names() != other.feature_names())
    refuse("the cases to be added compare other features; they come from another robot or program version");
  std::set<std::string> present;
  for (const Case& c : cases_) present.insert(content_of(c));
  CaseBase marked = other;
  marked.belong_to(model_identity_);
  std::int64_t added = 0;
  for (const Case& c : marked.cases()) {
    if (!present.insert(content_of(c)).second) continue;
    retain(c);
    ++added;
  }
  return added;
}

void CaseBase::learn() {
  std::vector<Case> known;
  std::copy_if(cases_.begin(), cases_.end(), std::back_inserter(known), is_known);
  metric_ = learn_metric(metric_.features, known);
}

std::string CaseBase::sha256() const {
  const bool tell_logs = std::any_of(cases_.begin(), cases_.end(), tells_of_its_log);
  ContentHash hash;
  hash.add(std::string(tell_logs ? "faultline/cases/2" : "faultline/cases/1"));
  hash.add_bits(metric_.features.size());
  for (const Feature& f : metric_.features) {
    hash.add(f.name);
    hash.add(f.scale);
    hash.add(f.weight);
  }
  hash.add(metric_.near_similarity);
  hash.add_bits(cases_.size());
  for (const Case& c : cases_) {
    hash.add_bits(static_cast<std::uint64_t>(c.id));
    add_content(hash, c);
    if (tell_logs) add_log(hash, c);
  }
  return hash.hex();
}

}  // namespace faultline
