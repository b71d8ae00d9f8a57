// SPDX-License-Identifier: MIT
#include "lib/diagnosis/merge_faults.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "lib/fault/fault_catalogue.hpp"

namespace faultline {
namespace {

constexpr double kCalm_s = 1.0;  // between two faults that are not one

double or_last(double time_s) {
  return std::isnan(time_s) ? std::numeric_limits<double>::infinity() : time_s;
}

/// Whether `later` is what `earlier` looks like a while on: nothing was healthy for long between them.
bool continues(const FaultFinding& earlier, const FaultFinding& later) {
  return later.decided_by != DecidedBy::criterion && !describe(earlier.label.kind).passes &&
         earlier.label.joint == later.label.joint && !(later.onset_s > or_last(earlier.end_s) + kCalm_s);
}

std::tuple<double, double, int> order_key(const FaultFinding& finding) {
  return {or_last(finding.onset_s), or_last(finding.alarm_s), finding.label.joint};
}

}  // namespace

std::vector<FaultFinding> merge_continued(std::vector<FaultFinding> faults) {
  std::vector<FaultFinding> merged;
  for (FaultFinding& fault : faults) {
    const auto same = std::find_if(merged.begin(), merged.end(),
                                   [&](const FaultFinding& earlier) { return continues(earlier, fault); });
    if (same == merged.end())
      merged.push_back(std::move(fault));
    else
      same->end_s = std::max(same->end_s, fault.end_s);
  }
  return merged;
}

void number_by_onset(std::vector<FaultFinding>& faults) {
  std::stable_sort(faults.begin(), faults.end(),
                   [](const auto& a, const auto& b) { return order_key(a) < order_key(b); });
  for (std::size_t i = 0; i < faults.size(); ++i) faults[i].id = static_cast<int>(i) + 1;
}

}  // namespace faultline
