// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/diagnose/decided_by.hpp"
#include "lib/diagnose/decision_basis.hpp"

namespace faultline {

struct DecisionOptions {
  VoteOptions votes{};
  double thin_confidence =
      0.2;                   ///< two agreeing networks that are on average less sure than this say nothing
  double clear_share = 0.5;  ///< more than this share of the votes settles a disagreement, or warns
};

/// Why a label was decided on.
enum class DecisionReason {
  networks_agree,  ///< both networks say so
  votes_settle,    ///< the networks disagree and the votes settle it
  evidence_alone,  ///< neither networks nor votes settle it; the fault explains the log best
  log_excludes,    ///< what networks or votes say explains the log much worse than the likeliest fault
  no_known_form,   ///< unknown: a change of any form explains the log much better than every known fault
};

/// What an episode is, decided once; all texts follow from it.
struct Decision {
  FaultLabel label;         ///< `unknown` at joint 0 for a fault of no known form
  double confidence = 0.0;  ///< 0 to 1: mean of the networks', share of the votes, or posterior
  DecidedBy decided_by = DecidedBy::evidence;
  DecisionReason reason = DecisionReason::evidence_alone;
  FaultLabel voted;  ///< what networks or votes said; FaultKind::none where they said nothing
};

/// What two networks and the votes of similar cases say of an episode: networks that agree are believed, else
/// the votes settle it. FaultKind::none where they settle nothing.
Decision opinion_on(const Episode& episode, const Votes& votes, const DecisionOptions& options = {});

/// Case-based decision on one episode (the paper's "dual classification with robust decision", figure 2, at
/// the level of the episode). The regression says which faults explain the log (DecisionBasis::likeliest and
/// as_likely). Among these, networks and cases choose (opinion_on()). Where they settle nothing, or name a
/// fault that the log excludes, the likeliest fault gives the name. Where a change of any form explains the
/// log much better than every known fault, the fault is unknown.
Decision decide(const DecisionBasis& basis, const DecisionOptions& options = {});

}  // namespace faultline
