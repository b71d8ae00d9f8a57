// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/identify/identification.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// Reasons not to rely on a learned model, in sentences.
struct ModelCaveats {
  std::vector<std::string> grave;  ///< its diagnoses are meaningless
  /// One of its healthy logs may contain a fault, which the model then treats as healthy: its findings are
  /// valid, the absence of findings is not.
  std::vector<std::string> contradictions;
  std::vector<std::string> minor;  ///< its diagnoses are less reliable than those of other models

  bool is_grave() const { return !grave.empty(); }
  void add(const ModelCaveats& more);
};

/// Lists doubts about a robot that explains the logs poorly, did not converge, or has negative friction.
ModelCaveats caveats_of(const Identification& identification);

/// Lists doubts about a model that misses or misnames many simulated faults, or raises false alarms. Missing
/// most is no grave doubt with second residuals: they find faults that these runs do not have.
ModelCaveats caveats_of(const Validation& validation, bool has_relations);

/// Joins all of them to one list, the grave first.
std::vector<std::string> listed(const ModelCaveats& doubts);

/// Returns those with which no log can be called healthy (Model::grave_doubts): grave and contradictions.
std::vector<std::string> against_healthy(const ModelCaveats& doubts);

/// Throws Error(input) that names the grave doubts and what to do, if there are any.
void refuse_grave(const ModelCaveats& doubts);

}  // namespace faultline
