// SPDX-License-Identifier: MIT
#include "lib/cases/case_hash.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "lib/core/hash.hpp"

namespace faultline {
namespace {

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

bool tells_of_its_log(const Case& c) {
  return !c.log_sha256.empty() || !std::isnan(c.onset_s) || !c.features_by.empty();
}

void add_log(ContentHash& hash, const Case& c) {
  hash.add(c.log_sha256);
  hash.add(c.onset_s);
  hash.add(c.features_by);
}

bool tells_who(const Case& c) {
  return !c.log_name.empty() || !c.robot.empty() || !c.person.empty() || !c.date.empty();
}

void add_who(ContentHash& hash, const Case& c) {
  for (const std::string& text : {c.log_name, c.robot, c.person, c.date}) hash.add(text);
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

std::string content_hash(const CaseBase& base) {
  const std::vector<Case>& cases = base.cases();
  const bool tell_who = base.robot() != CaseRobot{} || std::any_of(cases.begin(), cases.end(), tells_who);
  const bool tell_logs = tell_who || std::any_of(cases.begin(), cases.end(), tells_of_its_log);
  ContentHash hash;
  hash.add(std::string("faultline/cases/") + (tell_who ? "3" : tell_logs ? "2" : "1"));
  add_metric(hash, base.metric());
  if (tell_who) {
    hash.add(base.robot().name);
    hash.add(base.robot().axes);
  }
  hash.add_bits(cases.size());
  for (const Case& c : cases) {
    hash.add_bits(static_cast<std::uint64_t>(c.id));
    add_content(hash, c);
    if (tell_logs) add_log(hash, c);
    if (tell_who) add_who(hash, c);
  }
  return hash.hex();
}

std::string content_hash(const Case& c) {
  ContentHash hash;
  add_content(hash, c);
  add_log(hash, c);
  add_who(hash, c);
  return hash.hex();
}

}  // namespace faultline
