// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lib/cases/case.hpp"
#include "lib/core/issue.hpp"
#include "lib/core/joint.hpp"
#include "lib/diagnose/condition.hpp"
#include "lib/diagnose/stop/stop_answer.hpp"
#include "lib/explain/evidence_course.hpp"
#include "lib/explain/evidence_score.hpp"
#include "lib/fault/fault_kind.hpp"
#include "lib/log/time_axis.hpp"
#include "lib/residual/residuals.hpp"

/// The one result of diagnosing a log; every report is a rendering of it. Schema "faultline/diagnosis/1".
namespace faultline {

/// What decided on the label of a fault.
enum class DecidedBy {
  agreement,    ///< both networks
  cases,        ///< similar cases and the networks' opinions, by vote
  evidence,     ///< the likelihood of the physical hypotheses
  criterion,    ///< the fault criterion over single samples
  actuator,     ///< the second residual of measured against commanded torque
  control_law,  ///< that of commanded torque against the inputs of the controller
  tracking,     ///< that of the motion against its reference
  abstained,    ///< nothing: networks too unsure, or votes too even, to name a fault
};
const char* to_string(DecidedBy decided_by);

enum class Verdict {
  not_run,
  healthy,
  faulty,
  inconclusive,  ///< neither faulty nor surely healthy; `verdict_reason` gives the reason
};
const char* to_string(Verdict verdict);

/// A feature in which a case and an episode agree or differ.
struct PrecedentFeature {
  std::string name;  ///< of the feature, as in EpisodeFacts
  std::string what;  ///< in words
  std::string unit;
  double here = std::numeric_limits<double>::quiet_NaN();   ///< in the episode
  double there = std::numeric_limits<double>::quiet_NaN();  ///< in the case
  double difference = 0.0;  ///< in units of the usual difference between cases of the same fault
};

/// A case of the case base that resembles an episode.
struct Precedent {
  std::int64_t case_id = 0;
  FaultLabel label{};
  double similarity = 0.0;  ///< 0 to 1
  std::string what_was_done{};
  CaseOrigin origin = CaseOrigin::simulated;
  std::string origin_text{};  ///< in words, with who labelled it, and when
  std::string log{};          ///< in which it occurred; empty if not known, as the next three
  std::string robot{};
  std::string person{};
  std::string date{};
  bool voted = true;                      ///< false: too far behind for a vote, but near and not simulated
  std::vector<PrecedentFeature> alike{};  ///< a few, the most significant first
  std::vector<PrecedentFeature> unlike{};
};

struct Alternative {
  FaultLabel label;
  std::string why;
};

/// A number or a remark in support of a finding, or a warning against it.
struct EvidenceItem {
  std::string name;  ///< stable identifier, such as "log_likelihood_ratio"
  double value = std::numeric_limits<double>::quiet_NaN();
  std::string unit;
  std::string text;  ///< one line for a person
};

/// The features that the case base compares, so that a finding can be added to it as a case later.
struct EpisodeFacts {
  double evidence = std::numeric_limits<double>::quiet_NaN();  ///< log likelihood ratio (Episode::evidence)
  std::vector<std::pair<std::string, double>> features;  ///< by CaseBase::feature_names(); NaN = not measured
};

/// The size of a fault, in the measure of its kind.
struct FaultExtent {
  double size = std::numeric_limits<double>::quiet_NaN();
  double least_size = std::numeric_limits<double>::quiet_NaN();  ///< from which on it is reported as a fault
  std::string unit;                                              ///< "1" for a share of the torque
  /// The largest ratio of a size of the kind to its least size: below 1 the fault is too small to act on. NaN
  /// if no size is known.
  double times_least = std::numeric_limits<double>::quiet_NaN();
};

struct FaultFinding {
  int id = 0;  ///< from 1, in the order of onset
  FaultLabel label;
  FaultExtent extent;
  double onset_s = std::numeric_limits<double>::quiet_NaN();  ///< estimated start of the fault
  double alarm_s =
      std::numeric_limits<double>::quiet_NaN();  ///< earliest sample that would have raised the alarm
  double end_s = std::numeric_limits<double>::quiet_NaN();  ///< last sample that shows it
  int run = 0;                  ///< in which it began, from 1; 0 for a log with a single run
  double clock_offset_s = 0.0;  ///< of that run: time in the log minus time of its own clock
  double confidence = 0.0;      ///< 0 to 1
  Opinion mlp;
  Opinion rbfn;
  DecidedBy decided_by = DecidedBy::evidence;
  std::vector<Precedent> precedents;  ///< by origin, then the most similar first
  std::vector<Alternative> could_also_be;
  std::vector<EvidenceItem> evidence;
  std::string next_check;  ///< what a technician should look at next
  EpisodeFacts episode;
  EvidenceTrace trace;  ///< empty for a finding that is not from the regression
};

/// Code of the severe issue of a log that contradicts the model (wrong unit, sign, columns, clock or robot).
inline constexpr const char* kMisreadLog = "misread_log";

/// A stretch of a log in which a joint could not be judged for longer than a moment (judged_moment_s()), at
/// its end judged_moment_at_end_s(), or in which it was not judged in more than a quarter of ten moments.
struct UnjudgedStretch {
  Joint joint{};         ///< none: all, rows are missing
  double start_s = 0.0;  ///< last row before it that was judged, or the first row
  double end_s = 0.0;    ///< first row after it that was judged, or the last row
  bool lacks_position = false, lacks_torque = false;
  double share = 1.0;  ///< of it that was not judged: below 1 if some rows in it were judged
};

struct LogFacts {
  std::string path;  ///< as given if it is relative, else the file name, so that it names no machine
  std::string sha256;
  std::string format;
  std::int64_t rows_read = 0;
  std::int64_t rows_used = 0;
  std::int64_t judgeable_rows = 0;  ///< of those used: with position and torque of every joint, or tracked
  double start_s = std::numeric_limits<double>::quiet_NaN();
  double end_s = std::numeric_limits<double>::quiet_NaN();
  double sample_period_s = std::numeric_limits<double>::quiet_NaN();
  int joints = 0;
  bool has_velocity = false;
  bool is_tracked = false;                ///< without torque: compared with references only
  std::vector<Joint> not_tracked;         ///< of such a log: joints that could not be compared with one
  std::vector<LogRun> runs;               ///< of its clock; one if it never restarts, none without a file
  std::vector<UnjudgedStretch> unjudged;  ///< by start
  std::vector<Joint> resting;             ///< joints that hardly moved compared with the healthy logs
  std::vector<double> at_limit;           ///< by joint: share of the torques at Robot::torque_limit; or empty
  std::int64_t rows_unjudged = 0;         ///< of the joint log: without a position or torque, or left out
  bool is_whole = true;  ///< every row is used and judged, and none is missing within the log
  Issues issues;
};

struct ModelFacts {
  std::string name;
  std::string sha256;
  std::string cases_sha256;
  std::vector<std::string> notes{};         ///< remarks on the model for the reader, a sentence each
  std::vector<std::string> grave_doubts{};  ///< Model::grave_doubts
};

struct Diagnosis {
  LogFacts log;
  ModelFacts model;
  std::string program_version;
  Verdict verdict = Verdict::not_run;
  std::string verdict_reason;
  std::vector<JointResidual> residuals;     ///< of the MLP over the whole log, a joint each
  std::vector<FaultFinding> faults;         ///< by onset
  std::vector<FaultFinding> small_changes;  ///< below the least size of their kind: no faults, by onset
  std::vector<ConditionItem> condition;     ///< effects of the day; empty if they were not estimated
  /// By joint: noise level of the rows (torque that the model misses) over that of the learned logs, in the
  /// noisiest window; empty if it was not estimated.
  std::vector<double> roughness;
  EvidenceScore score{};      ///< of the torque balance; not known for a log that it did not judge
  double judged_share = 1.0;  ///< share of the log that the regression could use; 1 if it was not used
  std::vector<std::string>
      cannot_see;  ///< what this log and model cannot show (torque meaning, missing channels)
  std::optional<StopAnswer> stop{};  ///< what happened before the moment that was asked about
};

}  // namespace faultline
