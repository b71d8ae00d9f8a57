// SPDX-License-Identifier: MIT
#include "lib/diagnosis/decide_episode.hpp"

#include "lib/diagnosis/decision.hpp"
#include "lib/diagnosis/describe_episode.hpp"
#include "lib/diagnosis/finding.hpp"

namespace faultline {

FaultFinding decide_episode(const MonitoredEpisode& observed, const Model& model, const CaseBase& cases) {
  DescribedEpisode described = describe_episode(observed, model);
  DecisionBasis basis{
      std::move(described.evidence), std::move(described.episode), {}, observed.evidence.usual};
  basis.votes = votes_on(basis.episode, cases);
  return finding_of({observed, basis, decide(basis)}, model);
}

}  // namespace faultline
