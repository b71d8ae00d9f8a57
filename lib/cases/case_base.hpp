// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lib/cases/metric.hpp"

namespace faultline {

/// The robot that a base belongs to; both are empty in bases of programs that did not keep them.
struct CaseRobot {
  std::string name{};
  std::string axes{};  ///< base to tip, R turns and P slides, such as "RRP"

  bool operator==(const CaseRobot&) const = default;
};

/// What became of the cases that were merged into a base.
struct MergedCases {
  std::int64_t added = 0;
  std::int64_t updated = 0;  ///< were there, and people have said more of them since
};

/// The cases of one robot in memory, and how they are compared. Ids are unique and ascending, every case has
/// one number a feature (finite or NaN), and texts are UTF-8: the base refuses or mends what is not.
class CaseBase {
 public:
  CaseBase() = default;
  /// All features start with scale 1 and weight 1 until learn() is called. Throws Error(input) when a name is
  /// empty or given twice.
  explicit CaseBase(const std::vector<std::string>& feature_names);
  /// A base as a file held it; checks all that the class promises. Throws Error(input).
  CaseBase(Metric metric, std::vector<Case> cases);

  std::vector<std::string> feature_names() const;
  const Metric& metric() const { return metric_; }
  const std::vector<Case>& cases() const { return cases_; }
  /// Throws Error(usage) when there is no such case.
  const Case& at(std::int64_t id) const;

  /// Retain: adds an episode and gives its id. `c.id` is ignored. Throws Error(input) when the features are
  /// not those of the base or are infinite.
  std::int64_t retain(Case c);
  /// The same, with the id that the case has if that is above all others.
  std::int64_t retain_with_id(Case c);
  /// Revise: the decision was right, or was `label`. An empty `what_was_done` keeps the old one; so does an
  /// unsigned word that changes neither label nor outcome with who signed before.
  void confirm(std::int64_t id, std::optional<FaultLabel> label = {}, const std::string& what_was_done = "",
               const Signature& signature = {});
  /// Revise: the decision was wrong; `was` is what it was, if known.
  void reject(std::int64_t id, std::optional<FaultLabel> was = {}, const std::string& what_was_done = "",
              const Signature& signature = {});
  /// `c` in place of the case with its id. Throws as retain() and at().
  void replace(Case c);
  /// Its number may be given again when it was the last one.
  void remove(std::int64_t id);
  /// Adds the cases of `other` that are not there yet under new ids, of an event that is there
  /// (is_same_event()) what people said of it later; scales and weights stay, and what another model computed
  /// is marked (belong_to()). Throws Error(usage) for a robot of another kind, Error(input) when `other`
  /// compares other features.
  MergedCases merge(const CaseBase& other);
  /// Scales and weights from the cases whose fault is known (learn_metric).
  void learn();

  /// Of the metric and all cases, the same on every machine, whatever file or export they came from.
  std::string sha256() const;

  /// Identity of the model that the base was learned with; empty in bases of programs that gave none. It is
  /// not part of the content.
  const std::string& model_identity() const { return model_identity_; }
  /// Cases whose features another model computed, as far as that is known, are marked so (features_by).
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

}  // namespace faultline
