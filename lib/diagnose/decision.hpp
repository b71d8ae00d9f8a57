// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/cases/votes.hpp"
#include "lib/classify/episode_features.hpp"
#include "lib/diagnose/diagnosis.hpp"

namespace faultline {

/// The input of a decision on an episode.
struct DecisionBasis {
  /// The fault that explains the log best; FaultKind::unknown if the free form explains it much better.
  FaultLabel likeliest;
  std::vector<FaultLabel> as_likely;    ///< explain the log almost as well
  std::vector<LabelEvidence> evidence;  ///< of each label
  Episode episode;                      ///< features, and the opinions of both networks
  Votes votes;                          ///< of similar cases
  double limit = 0.0;                   ///< limit of the evidence, nats
};

/// A larger share of the votes settles a disagreement of the networks, or gives a warning.
inline constexpr double kClearShare = 0.5;

/// The reason for a label.
enum class DecisionReason {
  networks_agree,  ///< both networks give this label
  votes_settle,    ///< the networks disagree and the votes decide
  evidence_alone,  ///< neither networks nor votes decide; the fault explains the log best
  log_excludes,    ///< the label of networks or votes explains the log much worse than the likeliest fault
  no_known_form,   ///< unknown: the free form explains the log much better than every known fault
};

/// The decision on an episode; all texts follow from it.
struct Decision {
  FaultLabel label;         ///< `unknown` at joint 0 for a fault of no known form
  double confidence = 0.0;  ///< 0 to 1: mean of both networks, share of the votes, or posterior probability
  DecidedBy decided_by = DecidedBy::evidence;
  DecisionReason reason = DecisionReason::evidence_alone;
  FaultLabel voted;  ///< label by networks or votes; FaultKind::none if they decide nothing
};

/// Returns the label that both networks and the votes of similar cases give an episode: that of networks that
/// agree, else that of a clear majority of the votes. FaultKind::none if these decide nothing.
Decision opinion_on(const Episode& episode, const Votes& votes);

/// Case-based decision on one episode (the paper's "dual classification with robust decision", figure 2, at
/// the level of the episode). The regression finds the faults that explain the log (DecisionBasis::likeliest
/// and as_likely). Among these, networks and cases choose (opinion_on()). If they decide nothing, or name a
/// fault that the log excludes, the label is that of the likeliest fault. If the free form explains the log
/// much better than every known fault, the fault is unknown.
Decision decide(const DecisionBasis& basis);

/// Returns the reason for a decision, in one sentence.
std::string reason_in_words(const Decision& decision, const DecisionBasis& basis);

/// Lists what contradicts the decision among similar cases, a sentence each.
std::vector<std::string> warnings_of_cases(const Decision& decision, const Votes& votes);

}  // namespace faultline
