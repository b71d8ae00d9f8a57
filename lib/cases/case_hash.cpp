// SPDX-License-Identifier: MIT
#include "lib/cases/case_hash.hpp"

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

std::string content_hash(const CaseBase& base) {
  ContentHash hash;
  hash.add(std::string("faultline/cases/3"));
  add_metric(hash, base.metric());
  hash.add(base.robot().name);
  hash.add(base.robot().axes);
  hash.add_bits(base.cases().size());
  for (const Case& c : base.cases()) {
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
