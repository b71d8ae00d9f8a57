// SPDX-License-Identifier: MIT
#include "lib/diagnose/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "lib/core/text.hpp"
#include "lib/diagnose/blind_spots.hpp"
#include "lib/diagnose/least_size.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/log/quality.hpp"
#include "lib/log/recorder/corrected_source.hpp"
#include "lib/log/time_axis.hpp"

namespace faultline {
namespace {

constexpr double kOtherPeriod = 1.3;  // ratio of sample periods: noise and timing of the model hold below it
constexpr double kLeastPower = 0.5;   // share of simulated faults found: below it, no log is called healthy
constexpr double kFarBeyond = 3.0;    // normal ranges: beyond them the robot is not healthy any more
constexpr double kWild = 150.0;  // times healthy: the largest residual of healthy logs stays below half of it
constexpr double kRough = 3.0;   // times the noise of the learned logs: a fault may be hidden
constexpr std::int64_t kFewestUsableRows = 20;  // usable rows: with fewer a robot cannot be judged
constexpr double kFewestJudged = 0.75;    // share of the log: with less a healthy verdict is not possible
constexpr double kFewestJudgeable = 0.2;  // share of the rows: below it a log is inconclusive

constexpr double kEpisodeGap_s = 1.0;    // a longer time between two findings separates two faults
constexpr double kAtItsEnd_s = 0.3;      // a collision so near the end of a fault belongs to it
constexpr double kShaking_s = 1.4;       // longest vibration of springs and a controller after an onset
constexpr double kAfterShaking_s = 0.6;  // from its end to the onset of the lasting fault, at most

/// States at which joint the model misses so much more torque than in the learned logs that its validated
/// power does not hold for this log; empty if at none.
std::string why_too_rough(const std::vector<double>& roughness) {
  const auto worst = std::max_element(roughness.begin(), roughness.end());
  if (worst == roughness.end() || *worst < kRough) return "";
  return fmt::format(
      "no fault was found, but the torque residual is {:.2g} times as large at joint {} as in the learned "
      "logs, so that a fault there may be missed; if the robot is meant to be so, learn a model with such "
      "logs",
      *worst, Joint::at(static_cast<int>(worst - roughness.begin())));
}

/// States when the motion was so far from a fault-free one that something happened, although no fault
/// explains it; empty if never.
std::string why_large_residual(const std::vector<JointResidual>& residuals) {
  const auto worst = std::max_element(residuals.begin(), residuals.end(), [](const auto& a, const auto& b) {
    return !(a.velocity_peak >= b.velocity_peak);
  });
  if (worst == residuals.end() || !(worst->velocity_peak > kWild)) return "";
  return fmt::format(
      "no fault explains the log, but the motion of joint {} at {:.3f} s is not that of a fault-free robot "
      "({:.3g} times the healthy residual); check that moment for a position that jumped or stood still, or "
      "for missing rows",
      worst->joint, worst->velocity_peak_s, worst->velocity_peak);
}

/// States the severe issue of the log that excludes a healthy verdict; empty if there is none.
std::string why_too_damaged(const Issues& issues) {
  for (const Issue& issue : issues.all())
    if (issue.severity == Severity::severe)
      return fmt::format("no fault was found, but the log has a severe issue: {}", issue.message);
  return "";
}

/// States why the model cannot call any log healthy; empty if it can.
std::string why_unfit_model(const ModelFacts& model) {
  if (model.grave_doubts.empty()) return "";
  return fmt::format(
      "no fault was found, but this model cannot call a log healthy: {}; learn a model from logs that are "
      "known to be healthy",
      model.grave_doubts.front());
}

/// States the longest stretch in which a joint could not be judged; empty if there is none.
std::string why_not_judged(const LogFacts& log) {
  const auto longest = std::max_element(
      log.unjudged.begin(), log.unjudged.end(),
      [](const auto& a, const auto& b) { return a.end_s - a.start_s < b.end_s - b.start_s; });
  if (longest == log.unjudged.end()) return "";
  const std::size_t others = log.unjudged.size() - 1;
  const std::string more =
      others == 0 ? "" : fmt::format(" (and {} other stretch{})", others, others == 1 ? "" : "es");
  return fmt::format(
      "no fault was found in the judged part of the log, but {}{}; a fault may be missed if a joint is not "
      "judged for longer than {:.2g} s, in more than a quarter of {:.2g} s, or at the end",
      unjudged_words(*longest, log), more, judged_moment_s(log.sample_period_s),
      judged_window_s(log.sample_period_s));
}

/// States that too little of the log could be explained; empty if it was enough.
std::string why_little_judged(double judged_share) {
  if (judged_share >= kFewestJudged) return "";
  return fmt::format(
      "no fault was found, but the regression could use only {:.0f} % of the log: it needs some seconds of "
      "complete rows in succession, and rows or cells are missing too often, or the log is too short",
      100.0 * judged_share);
}

/// States that a log without motion cannot be called healthy; empty if a joint moves.
std::string why_at_rest(const LogFacts& log) {
  if (log.resting.empty() || std::ssize(log.resting) < log.joints) return "";
  return "no fault was found, but no joint moved: most faults show in motion only";
}

/// Names the part of the log that a healthy verdict covers: the whole log only if all of it was judged.
std::string judged_part(const LogFacts& log) {
  const auto read =
      std::count_if(log.runs.begin(), log.runs.end(), [](const LogRun& run) { return run.is_read; });
  if (read < std::ssize(log.runs)) {
    const auto run =
        std::find_if(log.runs.begin(), log.runs.end(), [](const LogRun& r) { return r.is_read; });
    return fmt::format("run {} of {}; the other runs were not read", run->run, log.runs.size());
  }
  if (log.is_whole) return "the whole log";
  const std::string rows = log.rows_unjudged > 0
                               ? fmt::format("{} of {} rows", log.rows_unjudged, log.rows_read)
                               : "a few moments";
  return fmt::format(
      "the log except {} that could not be judged, never more than {:.2g} s at a time or a quarter of {:.2g} "
      "s",
      rows, judged_moment_s(log.sample_period_s), judged_window_s(log.sample_period_s));
}

/// States why a log in which no fault was found is not called healthy; empty if it is.
std::string why_not_healthy(const Diagnosis& diagnosis, double power) {
  if (const std::string damage = why_too_damaged(diagnosis.log.issues); !damage.empty()) return damage;
  if (const std::string doubt = why_unfit_model(diagnosis.model); !doubt.empty()) return doubt;
  if (const std::string unjudged = why_not_judged(diagnosis.log); !unjudged.empty()) return unjudged;
  if (const std::string thin = why_little_judged(diagnosis.judged_share); !thin.empty()) return thin;
  if (const std::string rest = why_at_rest(diagnosis.log); !rest.empty()) return rest;
  if (power < kLeastPower)
    return fmt::format(
        "no fault was found, but the model finds only {:.0f} % of simulated faults; learn a model from "
        "healthy logs that resemble each other more",
        100.0 * power);
  if (const std::string rough = why_too_rough(diagnosis.roughness); !rough.empty()) return rough;
  if (const std::string wild = why_large_residual(diagnosis.residuals); !wild.empty()) return wild;
  if (const std::string far = beyond_normal(diagnosis.condition, kFarBeyond); !far.empty())
    return fmt::format(
        "no onset of a fault was found, but the robot has changed since the healthy logs were recorded: {}; "
        "if the change is intended, learn a model from recent logs",
        far);
  if (const std::vector<Joint>& joints = diagnosis.log.not_tracked; !joints.empty())
    return fmt::format(
        "joint {} could not be compared with a reference in this log; the other joints follow their "
        "references",
        joints.front());
  return "";
}

/// States why the log cannot be judged with this model; empty if it can.
std::string why_inconclusive(const LogFacts& log, double model_period_s) {
  for (const char* code : {kMisreadLog, kChangedColumns})
    if (const Issue* misread = log.issues.find(code)) return misread->message;
  const double ratio = log.sample_period_s / model_period_s;
  if (ratio > kOtherPeriod || ratio < 1.0 / kOtherPeriod)
    return fmt::format(
        "the log has a sample every {:.4g} s, the model was learned from logs with one every {:.4g} s; learn "
        "a model from healthy logs of this rate",
        log.sample_period_s, model_period_s);
  if (log.rows_used < kFewestUsableRows)
    return fmt::format("the log has {} usable rows; at least {} are needed to judge", log.rows_used,
                       kFewestUsableRows);
  if (static_cast<double>(log.judgeable_rows) < kFewestJudgeable * static_cast<double>(log.rows_used))
    return fmt::format("only {} of {} rows {}", log.judgeable_rows, log.rows_used,
                       log.is_tracked ? "could be compared with a reference that moves as in the healthy logs"
                                      : "have position and torque of every joint");
  return "";
}

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
bool may_be_at(const FaultFinding& finding, Joint joint) {
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

std::tuple<double, double, Joint> order_key(const FaultFinding& finding) {
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

Diagnosis with_verdict(Diagnosis diagnosis, const std::vector<FaultFinding>& faults, double model_period_s,
                       double power) {
  diagnosis.verdict = Verdict::inconclusive;
  diagnosis.verdict_reason = why_inconclusive(diagnosis.log, model_period_s);
  if (!diagnosis.verdict_reason.empty()) {
    diagnosis.condition.clear();
    return diagnosis;
  }
  FaultsBySize by_size = faults_by_size(faults);
  diagnosis.small_changes = std::move(by_size.small);
  std::vector<FaultFinding> found = numbered_by_onset(merge_continued(std::move(by_size.kept)));
  const Issue* scaled = diagnosis.log.issues.find(kScaledMotion);
  if (scaled && !found.empty()) {
    diagnosis.verdict_reason = "the deviations may come from the log itself: " + scaled->message;
    return diagnosis;
  }
  if (!found.empty()) {
    diagnosis.verdict = Verdict::faulty;
    diagnosis.verdict_reason = counted(std::ssize(found), "fault") + " found";
    diagnosis.faults = std::move(found);
    return diagnosis;
  }
  diagnosis.verdict_reason = why_not_healthy(diagnosis, power);
  if (!diagnosis.verdict_reason.empty()) return diagnosis;
  diagnosis.verdict = Verdict::healthy;
  diagnosis.verdict_reason = diagnosis.log.is_tracked
                                 ? "every joint that is judged follows its reference"
                                 : "the identified robot explains " + judged_part(diagnosis.log);
  if (const std::string beyond = beyond_normal(diagnosis.condition); !beyond.empty())
    diagnosis.verdict_reason += "; beyond its normal range: " + beyond;
  if (!diagnosis.small_changes.empty())
    diagnosis.verdict_reason += "; " + counted(std::ssize(diagnosis.small_changes), "change") +
                                " found, too small to be reported as a fault";
  return diagnosis;
}

}  // namespace faultline
