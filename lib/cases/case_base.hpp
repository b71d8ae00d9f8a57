// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lib/cases/metric.hpp"

namespace faultline {

struct CaseRobot {
  std::string name{};
  std::string axes{};  ///< base to tip, R turns and P slides, such as "RRP"

  bool operator==(const CaseRobot&) const = default;
};

/// Counts of the cases that were merged into a base.
struct MergedCases {
  std::int64_t added = 0;
  std::int64_t updated = 0;  ///< already present, with a later judgement by a person
};

/// The cases of one robot in memory, and the metric that compares them. Ids are unique and ascending, every
/// case has one number for each feature (finite or NaN), and texts are UTF-8: the base refuses other numbers
/// and repairs other texts.
class CaseBase {
 public:
  CaseBase() = default;
  /// All features have scale 1 and weight 1 until learn() is called. Throws Error(input) if a name is empty
  /// or occurs twice.
  explicit CaseBase(const std::vector<std::string>& feature_names);
  /// A base with the content of a file; checks all conditions of the class. Throws Error(input).
  CaseBase(Metric metric, std::vector<Case> cases);

  std::vector<std::string> feature_names() const;
  const Metric& metric() const { return metric_; }
  const std::vector<Case>& cases() const { return cases_; }
  /// Throws Error(usage) if there is no such case.
  const Case& at(std::int64_t id) const;

  /// Retain: adds an episode and returns its id; ignores `c.id`. Throws Error(input) if the features are not
  /// those of the base or are infinite.
  std::int64_t retain(Case c);
  /// Retains the case under its own id if that is above all others, else under a new one.
  std::int64_t retain_with_id(Case c);
  /// Revise: confirms the decision, or `label` if given. An empty `what_was_done` keeps the old text; an
  /// empty person or date keeps the old one if neither label nor outcome changes.
  void confirm(std::int64_t id, std::optional<FaultLabel> label = {}, const std::string& what_was_done = "",
               const Signature& signature = {});
  /// Revise: rejects the decision; `was` is the true label, if known.
  void reject(std::int64_t id, std::optional<FaultLabel> was = {}, const std::string& what_was_done = "",
              const Signature& signature = {});
  /// Replaces the case with the id of `c`. Throws as retain() and at() do.
  void replace(Case c);
  /// The id may be given again if it was the last one.
  void remove(std::int64_t id);
  /// Adds the cases of `other` that are not present, under new ids; of an event that is present
  /// (is_same_event()) takes over a later judgement. Keeps scales and weights, and marks features that
  /// another model computed (belong_to()). Throws Error(usage) for a robot of another kind, Error(input) if
  /// `other` compares other features.
  MergedCases merge(const CaseBase& other);
  /// Computes scales and weights from the cases whose fault is known (learn_metric).
  void learn();

  /// Hash of metric, robot and cases, the same on every machine, whatever file or export they came from.
  std::string sha256() const;

  /// Identity of the model that the base was learned with; empty until belong_to() sets it. It is not part of
  /// the content.
  const std::string& model_identity() const { return model_identity_; }
  /// Sets the identity of the model; marks cases whose features another known model computed (features_by).
  void belong_to(const std::string& model_identity);

  const CaseRobot& robot() const { return robot_; }
  void describe_robot(const CaseRobot& robot);

 private:
  Case& find(std::int64_t id);
  void check(const Case& c) const;
  void revise(Case& c, CaseOutcome outcome, const FaultLabel& label, const std::string& what_was_done,
              const Signature& signature);

  void take(Case c);

  Metric metric_;
  std::vector<Case> cases_;
  CaseRobot robot_;
  std::string model_identity_;
};

/// SHA-256 of a case without its id.
std::string content_hash(const Case& c);

/// Whether both cases are of one event: same log (SHA-256), onsets closer than those of two faults of one
/// robot, and same decision or same label. False if a log is not known.
bool is_same_event(const Case& a, const Case& b);

/// Returns the case of the base of the same event; null if there is none.
const Case* find_same_event(const CaseBase& base, const Case& c);

}  // namespace faultline
