// SPDX-License-Identifier: MIT
#include "lib/diagnose/merge_faults.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "lib/fault/fault_catalogue.hpp"

namespace faultline {
namespace {

constexpr double kEpisodeGap_s = 1.0;    // a longer time between two findings separates two faults
constexpr double kAtItsEnd_s = 0.3;      // a collision so near the end of a fault belongs to it
constexpr double kShaking_s = 1.4;       // longest vibration of springs and a controller after an onset
constexpr double kAfterShaking_s = 0.6;  // from its end to the onset of the lasting fault, at most

double or_last(double time_s) {
  return std::isnan(time_s) ? std::numeric_limits<double>::infinity() : time_s;
}

bool passes(const FaultFinding& finding) { return describe(finding.label.kind).passes; }
bool is_unknown(const FaultFinding& finding) { return finding.label.kind == FaultKind::unknown; }

/// Whether second residuals determine the end of the fault, so that a later finding is another fault.
bool has_its_end(const FaultFinding& finding) {
  return finding.decided_by == DecidedBy::actuator || finding.decided_by == DecidedBy::control_law;
}

/// Whether the healthy time between the two is too short to separate two faults.
bool follow_closely(const FaultFinding& earlier, const FaultFinding& later) {
  return later.decided_by != DecidedBy::criterion && !has_its_end(earlier) && !has_its_end(later) &&
         !(later.onset_s > or_last(earlier.end_s) + kEpisodeGap_s);
}

/// Whether `later` is `earlier` again after a short pause, or a collision at its end. Unknown disturbances
/// that follow closely are one, and collisions are part of it. What begins during a known fault is another.
bool continues(const FaultFinding& earlier, const FaultFinding& later) {
  const bool is_again = !passes(earlier) && earlier.label == later.label &&
                        (is_unknown(earlier) || !(later.onset_s < or_last(earlier.end_s)));
  const bool is_end = !passes(earlier) && passes(later) && earlier.label.joint == later.label.joint &&
                      std::abs(later.onset_s - or_last(earlier.end_s)) < kAtItsEnd_s;
  return follow_closely(earlier, later) && (is_again || is_end || (is_unknown(earlier) && passes(later)));
}

/// Whether `earlier` is a collision that is the onset of an unknown disturbance.
bool begins(const FaultFinding& earlier, const FaultFinding& later) {
  return follow_closely(earlier, later) && passes(earlier) && is_unknown(later);
}

/// Whether the finding, or an alternative of an unknown one, is at that joint.
bool may_be_at(const FaultFinding& finding, int joint) {
  if (!is_unknown(finding)) return finding.label.joint == joint;
  const auto& others = finding.could_also_be;
  return others.empty() || std::any_of(others.begin(), others.end(), [joint](const Alternative& other) {
           return other.label.joint == joint;
         });
}

/// Whether `earlier` is the vibration of a compliant machine after the onset of the lasting fault `later`: a
/// short unknown disturbance or collision at its joint, right before.
bool is_shaken_by(const FaultFinding& earlier, const FaultFinding& later) {
  const bool lasts = !passes(later) && !is_unknown(later), shakes = is_unknown(earlier) || passes(earlier);
  return lasts && shakes && may_be_at(earlier, later.label.joint) && follow_closely(earlier, later) &&
         earlier.end_s - earlier.onset_s < kShaking_s && later.onset_s > earlier.end_s - kShaking_s &&
         later.onset_s < earlier.end_s + kAfterShaking_s;
}

std::tuple<double, double, int> order_key(const FaultFinding& finding) {
  return {or_last(finding.onset_s), or_last(finding.alarm_s), finding.label.joint};
}

}  // namespace

std::vector<FaultFinding> merge_continued(std::vector<FaultFinding> faults) {
  std::vector<FaultFinding> merged;
  for (FaultFinding& fault : faults) {
    if (!merged.empty() && (begins(merged.back(), fault) || is_shaken_by(merged.back(), fault))) {
      fault.onset_s = merged.back().onset_s;
      fault.alarm_s = merged.back().alarm_s;
      merged.back() = std::move(fault);
      continue;
    }
    const auto same = std::find_if(merged.begin(), merged.end(),
                                   [&](const FaultFinding& earlier) { return continues(earlier, fault); });
    if (same == merged.end())
      merged.push_back(std::move(fault));
    else
      same->end_s = std::max(same->end_s, fault.end_s);
  }
  return merged;
}

std::vector<FaultFinding> numbered_by_onset(std::vector<FaultFinding> faults) {
  std::stable_sort(faults.begin(), faults.end(),
                   [](const auto& a, const auto& b) { return order_key(a) < order_key(b); });
  for (std::size_t i = 0; i < faults.size(); ++i) faults[i].id = static_cast<int>(i) + 1;
  return faults;
}

}  // namespace faultline
