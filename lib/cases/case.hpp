// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lib/core/fault_kind.hpp"

namespace faultline {

/// One network's word on an episode, as a case keeps it.
struct CaseOpinion {
  FaultLabel label;
  double confidence = 0.0;  ///< 0 to 1
};

/// What is known of an episode before it is decided: the query of case-based reasoning.
struct Episode {
  std::vector<double> features;  ///< scaled numbers with the meaning of CaseBase::feature_names()
  CaseOpinion mlp;
  CaseOpinion rbfn;
};

enum class CaseOutcome {
  unconfirmed,  ///< decided, nobody has said yet whether it was right
  confirmed,    ///< a person or the truth of a simulation says it was
  rejected,     ///< a person says it was not; `label` then holds what it was, if known
};

/// An episode with its decision and what came of it.
struct Case {
  std::int64_t id = 0;  ///< given by the case base
  Episode episode;
  FaultLabel label;  ///< the decision, or the truth once confirmed
  CaseOutcome outcome = CaseOutcome::unconfirmed;
  std::string what_was_done;  ///< by the technician
  std::string origin;         ///< "simulated", a log's name, an import
};

}  // namespace faultline
