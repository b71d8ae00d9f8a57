// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/diagnosis/decided_by.hpp"
#include "lib/diagnosis/decision_basis.hpp"

namespace faultline {

struct DecisionOptions {
  VoteOptions votes{};
  double thin_evidence = 5.0;    ///< nats: abstain below this log likelihood ratio
  double thin_confidence = 0.2;  ///< abstain when two agreeing networks are on average less sure than this
  double clear_share = 0.5;      ///< more than this share of the votes settles a disagreement, or warns
  double close_ratio = 10.0;     ///< nats: labels whose evidence is this near cannot be told apart by it
};

/// Why a label was decided on.
enum class DecisionReason {
  thin_evidence,     ///< abstained: the evidence is too small
  hardly_believed,   ///< abstained: the networks agree, but hardly believe it
  networks_agree,    ///< both networks say so
  nothing_similar,   ///< unknown: the networks disagree and no recorded case is near
  votes_even,        ///< abstained: the networks disagree and the votes do not settle it
  votes_settle,      ///< the networks disagree and the votes settle it
  likelihood_names,  ///< neither networks nor cases name a fault, the likelihood does
  lacks_evidence,    ///< the likelihood of what networks and cases say would have raised no alarm
  others_refuted,    ///< what networks and cases say leaves far more than noise, the likeliest fault does not
  all_refuted,       ///< unknown: every known fault leaves far more than noise
  joint_is_held,     ///< what networks or cases call a free joint stands still under torque
  push_lasts,        ///< unknown: what looks like a push goes on for longer than pushes do
};

/// What an episode is, decided once; all texts follow from it.
struct Decision {
  FaultLabel label;         ///< `unknown` at joint 0 when abstained or when nothing recorded resembles it
  double confidence = 0.0;  ///< 0 to 1: mean of the networks', share of the votes, or posterior
  DecidedBy decided_by = DecidedBy::abstained;
  DecisionReason reason = DecisionReason::thin_evidence;
  /// What networks or votes called it, before the size of a torque loss gave it its name.
  FaultLabel voted;
};

/// Case-based decision on one episode (the paper's "dual classification with robust decision", figure 2, at
/// the level of the episode). Two networks that agree are believed; when they disagree, the votes of similar
/// cases and of both networks settle it; with nothing near it is an unknown fault. A loss of nearly all
/// torque then is a free joint, and where all that leaves no name, the likelihood gives one, if a network
/// seconds it or nothing else comes near. A name whose own likelihood would have raised no alarm gives way to
/// the likeliest known fault where that stands out, to an unknown one far beyond the alarm, and else to no
/// finding (FaultKind::none). A name that leaves far more than noise unexplained (is_far_from_white) does not
/// stand: the likeliest known fault takes its place, or, where that leaves as much, the fault is unknown.
/// Without evidence of labels none of the three happens. A joint that stands still under torque is not free:
/// the likeliest other fault gives the name.
Decision decide(const DecisionBasis& basis, const DecisionOptions& options = {});

}  // namespace faultline
