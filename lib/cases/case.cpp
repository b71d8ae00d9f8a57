// SPDX-License-Identifier: MIT
#include "lib/cases/case.hpp"

#include <array>
#include <bit>
#include <cmath>

#include "lib/cases/case_base.hpp"
#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "lib/fault/fault_catalogue.hpp"

namespace faultline {
namespace {

/// Returns " by A. Weber on 2026-03-02", without the parts that are not known.
std::string signature_words(const Case& c) {
  return (c.person.empty() ? "" : " by " + c.person) + (c.date.empty() ? "" : " on " + c.date);
}

/// Returns the signature, or words that it is not known.
std::string signed_words(const Case& c) {
  const std::string words = signature_words(c);
  return words.empty() ? ", author and date not recorded" : words;
}

std::string seen_words(const Case& c, const std::string& robot) {
  const std::string& name = c.robot.empty() ? robot : c.robot;
  const std::string log = log_name_of(c);
  return (name.empty() ? "" : ", robot " + name) +
         (log.empty() ? (c.origin == kByHandOrigin ? ", recorded by hand without a log" : "")
                      : ", log " + log);
}

std::string revision_words(const Case& c) {
  if (c.outcome == CaseOutcome::rejected) return ", rejected" + signature_words(c);
  return signature_words(c).empty() ? "" : ", confirmed" + signature_words(c);
}

std::string learned_words(const Case& c) {
  if (c.origin == kLabelledOrigin) {
    return "labelled log " + c.log_name + (c.robot.empty() ? "" : ", robot " + c.robot);
  }
  if (!c.robot.empty()) return "simulated with the model of robot " + c.robot;
  return c.features_by.empty() ? "simulated with the robot's model" : "simulated with another model";
}

std::string field_words(const Case& c) {
  const std::string called = " (was called: " + plain_words(c.decision) + ")";
  if (c.outcome == CaseOutcome::confirmed)
    return "confirmed in the field" + signed_words(c) + (c.label == c.decision ? "" : called);
  if (c.outcome == CaseOutcome::unconfirmed)
    return "diagnosed, not confirmed" +
           (signature_words(c).empty() ? "" : " (added" + signature_words(c) + ")");
  const char* const word = c.label.kind == FaultKind::unknown ? "rejected" : "corrected";
  return word + (" in the field" + signed_words(c)) + called;
}

/// Hashes numbers and texts as an unambiguous sequence of bytes.
class ContentHash {
 public:
  void add(const std::string& text) {
    add_bits(text.size());
    hash_.update(text);
  }
  void add(double x) { add_bits(std::bit_cast<std::uint64_t>(std::isnan(x) ? std::nan("") : x + 0.0)); }
  void add(const FaultLabel& label) {
    add(std::string(to_string(label.kind)));
    add_bits(static_cast<std::uint64_t>(label.joint.number()));
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
  hash.add(c.log_sha256);
  hash.add(c.onset_s);
  hash.add(c.features_by);
  for (const std::string& text : {c.log_name, c.robot, c.person, c.date}) hash.add(text);
}

void add_metric(ContentHash& hash, const Metric& metric) {
  hash.add_bits(metric.features.size());
  for (const Feature& f : metric.features) {
    hash.add(f.name);
    hash.add(f.scale);
    hash.add(f.weight);
  }
  hash.add(metric.near_similarity);
}

}  // namespace

const char* to_string(CaseOutcome outcome) {
  static constexpr std::array kNames{"unconfirmed", "confirmed", "rejected"};
  static_assert(kNames.size() == static_cast<std::size_t>(CaseOutcome::rejected) + 1);
  return kNames[static_cast<std::size_t>(outcome)];
}

CaseOutcome case_outcome_from(const std::string& name) {
  for (const auto outcome : {CaseOutcome::unconfirmed, CaseOutcome::confirmed, CaseOutcome::rejected})
    if (name == to_string(outcome)) return outcome;
  throw Error(ErrorCode::usage, "outcome",
              "\"" + name + "\" is not an outcome; expected one of unconfirmed, confirmed, rejected");
}

const char* to_string(CaseOrigin origin) {
  static constexpr std::array kNames{"field", "labelled", "diagnosed", "simulated"};
  static_assert(kNames.size() == static_cast<std::size_t>(CaseOrigin::simulated) + 1);
  return kNames[static_cast<std::size_t>(origin)];
}

CaseOrigin case_origin_from(const std::string& name) {
  for (const auto origin :
       {CaseOrigin::field, CaseOrigin::labelled, CaseOrigin::diagnosed, CaseOrigin::simulated})
    if (name == to_string(origin)) return origin;
  throw Error(ErrorCode::usage, "origin",
              "\"" + name + "\" is not an origin; expected one of field, labelled, diagnosed, simulated");
}

bool fault_is_known(const Case& c) {
  return !(c.outcome == CaseOutcome::rejected && c.label.kind == FaultKind::unknown);
}

bool is_of_field(const Case& c) { return c.origin != kSimulatedOrigin && c.origin != kLabelledOrigin; }

CaseOrigin origin_of(const Case& c) {
  if (c.origin == kSimulatedOrigin) return CaseOrigin::simulated;
  if (c.origin == kLabelledOrigin) return CaseOrigin::labelled;
  return c.outcome != CaseOutcome::unconfirmed && fault_is_known(c) ? CaseOrigin::field
                                                                    : CaseOrigin::diagnosed;
}

std::string log_name_of(const Case& c) {
  if (!c.log_name.empty()) return c.log_name;
  return is_of_field(c) && c.origin != kByHandOrigin ? c.origin : "";
}

std::string origin_words(const Case& c, const std::string& robot) {
  std::string words =
      is_of_field(c) ? field_words(c) + seen_words(c, robot) : learned_words(c) + revision_words(c);
  if (!c.features_by.empty() && origin_of(c) != CaseOrigin::simulated)
    words += ", compared by features of another model";
  return words;
}

std::string CaseBase::sha256() const {
  ContentHash hash;
  hash.add(std::string("faultline/cases/3"));
  add_metric(hash, metric_);
  hash.add(robot_.name);
  hash.add(robot_.axes);
  hash.add_bits(cases_.size());
  for (const Case& c : cases_) {
    hash.add_bits(static_cast<std::uint64_t>(c.id));
    add_content(hash, c);
  }
  return hash.hex();
}

std::string content_hash(const Case& c) {
  ContentHash hash;
  add_content(hash, c);
  return hash.hex();
}

}  // namespace faultline
