// SPDX-License-Identifier: MIT
#include "lib/diagnose/monitor/monitor.hpp"

#include <algorithm>
#include <deque>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "lib/diagnose/monitor/explain_monitor.hpp"
#include "lib/diagnose/monitor/log_tally.hpp"
#include "lib/diagnose/monitor/monitored_log.hpp"
#include "lib/diagnose/relation_findings.hpp"
#include "lib/explain/explain_log.hpp"
#include "lib/log/log.hpp"
#include "lib/log/transformed/changed_source.hpp"
#include "lib/log/transformed/empty_rows_source.hpp"
#include "lib/residual/relation/relation_detector.hpp"
#include "lib/residual/residuals.hpp"

namespace faultline {
namespace {

/// A log that passes each segment to a callback as it is read.
class TappedSource : public ChangedSource {
 public:
  using Tap = std::function<void(const Log& segment)>;

  /// After a rewind, `tap` gets the segments once more.
  TappedSource(LogSource& source, Tap tap) : ChangedSource(source), tap_(std::move(tap)) {}

  bool next(Log& segment) override {
    if (!source_.next(segment)) return false;
    tap_(segment);
    return true;
  }

 private:
  Tap tap_;
};

/// Leads the segments of a log through the second residuals of a model: those of torque or, if the log has
/// none, those of tracking.
class RelationMonitor {
 public:
  /// `relations` outlive this.
  RelationMonitor(const std::vector<SignalRelation>& relations, bool by_tracking) {
    for (const SignalRelation& relation : relations) {
      watches_.emplace_back(relation);
      is_watched_.push_back((relation.kind == RelationKind::tracking) == by_tracking);
    }
  }

  bool monitors_any() const {
    return std::any_of(is_watched_.begin(), is_watched_.end(), [](char watched) { return watched != 0; });
  }
  void take(const Log& segment) {
    for (std::size_t i = 0; i < watches_.size(); ++i)
      if (is_watched_[i]) watches_[i].take(segment);
  }
  /// After the last segment.
  void finish() {
    for (RelationDetector& watch : watches_) watch.finish();
  }

  /// By onset.
  std::vector<RelationEpisode> episodes() const {
    std::vector<RelationEpisode> all;
    for (const RelationDetector& watch : watches_)
      all.insert(all.end(), watch.episodes().begin(), watch.episodes().end());
    std::stable_sort(all.begin(), all.end(),
                     [](const auto& a, const auto& b) { return a.onset_s < b.onset_s; });
    return all;
  }
  /// By relation: for how long the log could be judged, s; 0 for relations that are not watched.
  std::vector<double> judged_s() const { return of_each(&RelationDetector::judged_s); }
  /// By relation: for how long its inputs were beyond the learned range, s.
  std::vector<double> beyond_s() const { return of_each(&RelationDetector::beyond_s); }

 private:
  std::vector<double> of_each(double (RelationDetector::*number)() const) const {
    std::vector<double> out;
    for (const RelationDetector& watch : watches_) out.push_back((watch.*number)());
    return out;
  }

  std::deque<RelationDetector> watches_;
  std::vector<char> is_watched_;
};

/// The fault criterion applied to one series of outputs along a log.
class CriterionDetector {
 public:
  CriterionDetector(const CriterionOptions& options, const OutputMeaning& meaning)
      : options_(options), meaning_(meaning) {}

  void take(const Eigen::VectorXd& time, const Eigen::MatrixXd& outputs) {
    for (const SampleEpisode& episode : apply_criterion(options_, meaning_, time, outputs, state_))
      episodes_.push_back(episode);
  }
  /// Ends an open episode, after the last sample.
  void finish() {
    if (const auto open = open_episode(meaning_, state_)) episodes_.push_back(*open);
  }
  const std::vector<SampleEpisode>& episodes() const { return episodes_; }

 private:
  CriterionOptions options_;
  OutputMeaning meaning_;
  CriterionState state_;
  std::vector<SampleEpisode> episodes_;
};

/// Returns the opinion of one network alone during an episode.
Opinion opinion_on(const SampleEpisode& episode, const std::vector<SampleEpisode>& own) {
  for (const SampleEpisode& other : own)
    if (other.alarm_s <= episode.end_s && other.end_s >= episode.onset_s)
      return {other.label, other.confidence};
  return {};
}

CriterionDetector make_detector(const SampleMode& samples, const DiagnoseOptions& options) {
  CriterionOptions criterion =
      options.criterion == CriterionKind::consecutive ? samples.consecutive : samples.log_odds;
  if (options.g > 0) criterion.g = options.g;
  return {criterion, {samples.classifier.classes, samples.classifier.prior}};
}

/// The method of the paper: both networks over the residuals of each sample, the fault criterion on their
/// average (figure 2) and on each alone (figure 1), which gives the opinion of that network. The criterion is
/// that of the options, with the tuning of the model.
class SampleMonitor {
 public:
  SampleMonitor(const SampleMode& samples, const DiagnoseOptions& options)
      : classifier_(samples.classifier),
        average_(make_detector(samples, options)),
        mlp_(average_),
        rbfn_(average_) {}

  void take(const Residuals& residuals) {
    const SampleOutputs outputs = classify_samples(classifier_, residuals);
    average_.take(outputs.time, outputs.average());
    mlp_.take(outputs.time, outputs.mlp);
    rbfn_.take(outputs.time, outputs.rbfn);
  }
  /// After the last segment.
  void finish() {
    for (CriterionDetector* each : {&average_, &mlp_, &rbfn_}) each->finish();
  }
  std::vector<SampleAlarm> alarms() const {
    std::vector<SampleAlarm> alarms;
    for (const SampleEpisode& episode : average_.episodes())
      alarms.push_back(
          {episode, {opinion_on(episode, mlp_.episodes()), opinion_on(episode, rbfn_.episodes())}});
    return alarms;
  }

 private:
  const SampleClassifier& classifier_;
  CriterionDetector average_, mlp_, rbfn_;
};

/// Whether the log has no torque that the model can judge. Rewinds it before and after. Throws Error(input)
/// for a log with another number of joints than the model's robot.
bool lacks_torque(LogSource& log, const Model& model) {
  if (!model.has_mechanics()) return true;
  log.rewind();
  Log first;
  const bool has_rows = log.next(first);
  if (has_rows) check_joints(first, log, model);
  const bool lacks = has_rows && first.tau.empty();
  log.rewind();
  return lacks;
}

/// Judges the second residuals of the whole log, before its torque balance. Rewinds the log after reading.
RelationMonitor monitored_relations(LogSource& log, const Model& model) {
  RelationMonitor out(model.relations, false);
  if (!out.monitors_any()) return out;
  EmptyRowsSource filled(log);
  for (Log segment; filled.next(segment);) out.take(segment);
  out.finish();
  log.rewind();
  return out;
}

/// Reads a log to its end and returns its facts; `take` gets each segment.
LogFacts read_facts(LogSource& log, const Model& model, const TappedSource::Tap& take) {
  LogTally tally;
  for (Log segment; log.next(segment);) {
    tally.take(segment, log, model);
    tally.unjudged.take(segment, log.identity().runs);
    take(segment);
  }
  return log_facts(log, tally, model);
}

MonitoredLog monitor_tracking(LogSource& log, const Model& model) {
  RelationMonitor relations(model.relations, true);
  MonitoredLog out;
  out.log = read_facts(log, model, [&](const Log& segment) { relations.take(segment); });
  relations.finish();
  out.relation_episodes = relations.episodes();
  out.relations_judged_s = relations.judged_s();
  out.log.is_tracked = true;
  out.log.not_tracked = joints_not_tracked(model, out.relations_judged_s);
  out.log.judgeable_rows = std::min(out.log.judgeable_rows, rows_tracked(model, out.relations_judged_s));
  return out;
}

}  // namespace

MonitoredLog monitor(LogSource& log, const Model& model, const DiagnoseOptions& options) {
  if (lacks_torque(log, model)) return monitor_tracking(log, model);
  const bool by_samples = options.mode == ClassifyMode::samples;
  const RelationMonitor relations = by_samples ? RelationMonitor({}, false) : monitored_relations(log, model);
  ExplainMonitor explained(model, stretches_of(relations.episodes(), model.robot.log.torque));
  SampleMonitor samples(model.samples, options);
  LogTally tally;
  TappedSource counted(log, [&](const Log& segment) { tally.take(segment, log, model); });
  EmptyRowsSource filled(counted);
  ResidualState state;
  ResidualSummary whole;
  for (Log segment; filled.next(segment);) {
    tally.unjudged.take(segment, log.identity().runs);
    Residuals residuals = compute_residuals(model.residual, segment, state);
    whole.add(residuals);
    if (by_samples)
      samples.take(residuals);
    else
      explained.take(segment, std::move(residuals), log.identity().runs);
  }
  explained.finish();
  samples.finish();
  LogFacts facts = log_facts(log, tally, model);
  facts.is_whole = facts.is_whole && filled.stage().rows_put_in() == 0;
  return {.log = std::move(facts),
          .residuals = whole.joints(),
          .episodes = explained.episodes(),
          .sample_alarms = samples.alarms(),
          .day = explained.day(),
          .relation_episodes = relations.episodes(),
          .stretches = explained.stretches(),
          .relations_judged_s = relations.judged_s(),
          .relations_beyond_s = relations.beyond_s(),
          .roughness = explained.noise_level(),
          .judged_share = by_samples ? 1.0 : explained.judged_share(),
          .score = explained.score()};
}

MonitoredLog monitor_at(LogSource& log, const Model& model, double onset_s, double end_s) {
  const UniformLog uniform = uniform_log(log, model.sample_period_s);
  MonitoredLog out;
  if (!can_explain(uniform, model.explain.robot)) return out;
  std::optional<ExplainedFault> fault = explain_at(uniform, model.explain, onset_s, end_s);
  if (!fault) return out;
  ResidualState state;
  ResidualSummary summary(onset_s, onset_s + kEpisodeResiduals_s);
  log.rewind();
  for (Log segment; log.next(segment);) summary.add(compute_residuals(model.residual, segment, state));
  const double until_s = std::min(fault->claim.end_s, uniform.time_s(uniform.rows() - 1));
  out.episodes.push_back({std::move(*fault), until_s, summary.joints()});
  return out;
}

MonitoredLog read_unjudged(LogSource& log, const Model& model) {
  log.rewind();
  MonitoredLog out;
  out.log = read_facts(log, model, [](const Log&) {});
  return out;
}

}  // namespace faultline
