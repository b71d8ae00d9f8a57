// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/identify/identification.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// What speaks against a learned model, in sentences.
struct ModelDoubts {
  std::vector<std::string> grave;  ///< its diagnoses would mean nothing
  /// One of the logs that it was learned from may hold a fault, which it takes for healthy: what it finds
  /// counts, that it finds nothing does not.
  std::vector<std::string> contradictions;
  std::vector<std::string> minor;  ///< they mean less than those of other models

  bool is_grave() const { return !grave.empty(); }
  void add(const ModelDoubts& more);
};

/// A robot that does not explain the logs, or that no robot is.
ModelDoubts doubts_about(const Identification& identification);

/// A model that misses most of the faults it was trained on, or alarms where there are none. Missing most is
/// no grave doubt where second residuals judge the logs, too: they find faults that these runs do not ask
/// for.
ModelDoubts doubts_about(const Validation& validation, bool has_relations);

/// All of them as one list, the grave first.
std::vector<std::string> listed(const ModelDoubts& doubts);

/// Those with which no log can be called healthy (Model::grave_doubts).
std::vector<std::string> against_healthy(const ModelDoubts& doubts);

/// Throws Error(input) that names the grave doubts and what to do.
void refuse_grave(const ModelDoubts& doubts);

}  // namespace faultline
