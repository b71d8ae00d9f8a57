// SPDX-License-Identifier: MIT
#include "lib/learn/learn.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <filesystem>
#include <iterator>
#include <utility>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/error.hpp"
#include "lib/core/parallel.hpp"
#include "lib/diagnose/monitor/monitor.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/learn/consistent_robot.hpp"
#include "lib/learn/day_differences.hpp"
#include "lib/learn/model_caveats.hpp"
#include "lib/learn/tracking_model.hpp"
#include "lib/learn/training_cases.hpp"
#include "lib/learn/twin_study.hpp"
#include "lib/log/remembered_source.hpp"
#include "lib/log/transformed/empty_rows_source.hpp"
#include "lib/model/model_files.hpp"
#include "lib/plausibility/plausible_units.hpp"
#include "lib/residual/relation/learn_relations.hpp"

namespace faultline {
namespace {

constexpr double kFewestAlarms = 1e-6, kMostAlarms = 100.0;  // bounds of the option, per hour

// Approximate shares of the work that are done after its stages.
constexpr double kIdentified = 0.25, kResidualsLearned = 0.35, kSimulated = 0.8, kTrained = 0.85;

constexpr double kEnoughFound = 0.5;  // of the training runs: if fewer are found, as many again are simulated

// Disjoint streams of seeds.
constexpr std::uint64_t kTrainingSeeds = 0, kMoreSeeds = 500'000, kValidationSeeds = 1'000'000,
                        kHealthyValidationSeeds = 3'000'000, kLimitSeeds = 2'000'000, kSeedBlock = 10'000'000;

constexpr int kSampleRuns = 6;  // runs of a label for the sample mode, two thirds for training

CriterionOptions tuned(const CriterionOptions& start, const SampleClassifier& classifier,
                       const std::vector<LabelledResiduals>& runs) {
  const OutputMeaning meaning{classifier.classes, classifier.prior};
  std::vector<LabelledOutputs> outputs;
  for (const LabelledResiduals& run : runs) {
    const SampleOutputs out = classify_samples(classifier, run.residuals);
    outputs.push_back({out.time, out.average(), run.fault, run.onset_s});
  }
  return tune_criterion(start, meaning, outputs).best;
}

/// Selects the runs for the sample mode: all healthy ones, and a few of each label that shows in each sample.
std::vector<LabelledResiduals> sample_mode_runs(std::vector<LabelledResiduals> runs) {
  std::vector<LabelledResiduals> out;
  std::vector<FaultLabel> taken;
  for (LabelledResiduals& run : runs) {
    const bool is_healthy = run.fault.kind == FaultKind::none;
    if (!is_healthy && (!describe(run.fault.kind).shows_in_each_sample ||
                        std::ranges::count(taken, run.fault) == kSampleRuns))
      continue;
    if (!is_healthy) taken.push_back(run.fault);
    out.push_back(std::move(run));
  }
  return out;
}

/// Trains the paper's classifiers on the residuals of simulated runs and tunes both criteria on every third
/// of them, which it does not train on. It uses all healthy runs, and the first few runs of each label whose
/// fault shows in every sample while it lasts.
SampleMode learn_sample_mode(const Model& model, std::vector<LabelledResiduals> runs) {
  runs = sample_mode_runs(std::move(runs));
  std::vector<LabelledResiduals> training, tuning;
  for (std::size_t i = 0; i < runs.size(); ++i)
    (i % 3 == 2 ? tuning : training).push_back(std::move(runs[i]));
  SampleMode mode;
  mode.classifier = train_sample_classifier(training, model.residual);
  mode.consecutive = tuned(mode.consecutive, mode.classifier, tuning);
  mode.log_odds = tuned(mode.log_odds, mode.classifier, tuning);
  return mode;
}

std::vector<ModelSource> sources_of(const std::vector<IdentifiedLog>& healthy,
                                    std::span<const LabelledLog> labelled) {
  std::vector<ModelSource> sources;
  for (const IdentifiedLog& log : healthy)
    sources.push_back({std::filesystem::path(log.path).filename().string(), log.sha256, log.rows,
                       log.left_out ? kLeftOut : to_string(FaultKind::none)});
  for (const LabelledLog& log : labelled)
    sources.push_back({std::filesystem::path(log.log->identity().path).filename().string(),
                       log.log->identity().sha256, log.log->identity().rows_read, to_string(log.label.kind)});
  return sources;
}

/// Nats that are added to the usual limits for this rate of false alarms: a log-likelihood ratio exceeds t by
/// chance with a probability of at most exp(-t) (Wald, 1945), so x nats more divide that rate by exp(x).
double limit_shift(double alarms_per_hour) { return elementary::log(kUsualAlarmsPerHour / alarms_per_hour); }

std::vector<MonitoredRun> monitored(std::span<const LabelledLog> labelled, const TorqueConversion& conversion,
                                    const Model& model) {
  std::vector<MonitoredRun> runs;
  for (const LabelledLog& entry : labelled) {
    ConvertedTorqueSource log(*entry.log, conversion);
    log.rewind();
    runs.push_back({.label = entry.label,
                    .onset_s = entry.onset_s,
                    .origin = kLabelledOrigin,
                    .log = monitor(log, model)});
  }
  return runs;
}

std::vector<std::vector<LeastFound>> least_found_in(const std::vector<UniformLog>& days, const Model& model,
                                                    int threads) {
  std::vector<std::vector<LeastFound>> out(days.size());
  parallel_for(static_cast<int>(days.size()), threads,
               [&](int k) { out[k] = least_found(days[k], model.explain, model.labels); });
  return out;
}

double share_found(const TwinStudy& study) {
  const auto found = std::count_if(study.runs.begin(), study.runs.end(),
                                   [](const MonitoredRun& run) { return episode_of_fault(run) != nullptr; });
  return static_cast<double>(found) / static_cast<double>(std::max<std::size_t>(study.runs.size(), 1));
}

TwinStudy joined(TwinStudy a, TwinStudy b) {
  std::move(b.runs.begin(), b.runs.end(), std::back_inserter(a.runs));
  std::move(b.residuals.begin(), b.residuals.end(), std::back_inserter(a.residuals));
  return a;
}

/// Trains the networks and fills the case base with simulated faults of the identified robot, and validates
/// them on runs that were not used in training.
void learn_from_twin(Learned& out, std::span<const LabelledLog> labelled, const TorqueConversion& conversion,
                     const std::vector<UniformLog>& days, const LearnOptions& options,
                     const Progress& progress) {
  Model& model = out.model;
  const Identification explained = with_explained_robot(out.identification, model.explain.robot);
  const Twin twin{
      &explained,         &model.motion, day_differences(model.explain.robot), model.sample_period_s,
      model.has_velocity, options.twin};
  const std::uint64_t seed = options.seed * kSeedBlock;
  auto runs_of = [&](const std::vector<FaultLabel>& labels, std::uint64_t stream, const Progress& part,
                     TwinStudyOptions judged) {
    judged.first_seed = seed + stream;
    judged.threads = options.threads;
    return monitored_twin_runs(twin, model, labels, judged, part);
  };
  auto faults = [&](int each) { return labels_to_simulate(model.labels, each, options.kinds); };
  const std::vector<FaultLabel> calm(options.healthy_runs, FaultLabel{});
  const TwinStudy healthy = runs_of(calm, kLimitSeeds, {}, {.keep_residuals = true});
  for (const MonitoredRun& run : healthy.runs)
    for (const MonitoredEpisode& alarm : run.log.episodes)
      model.explain.limits = above_false_alarm(model.explain.limits, alarm.fault);

  const auto training_runs = [&](std::uint64_t stream) {
    return runs_of(faults(options.runs_per_label), stream, part_of(progress, kResidualsLearned, kSimulated),
                   {.at_known_times = true, .keep_residuals = true});
  };
  TwinStudy faulty = training_runs(kTrainingSeeds);
  if (share_found(faulty) < kEnoughFound) faulty = joined(std::move(faulty), training_runs(kMoreSeeds));
  if (progress) progress("training networks on samples", kSimulated);
  std::vector<LabelledResiduals> residuals = std::move(faulty.residuals);
  residuals.insert(residuals.end(), healthy.residuals.begin(), healthy.residuals.end());
  model.samples = learn_sample_mode(model, std::move(residuals));
  std::vector<MonitoredRun> runs = std::move(faulty.runs);
  const std::size_t simulated = runs.size();
  for (MonitoredRun& run : monitored(labelled, conversion, model)) runs.push_back(std::move(run));

  if (progress) progress("training networks on episodes", kSimulated);
  const std::vector<Case> training = training_cases(runs, model);
  EpisodeClassifierOptions classifying;
  classifying.seed = options.seed;
  model.episode_classifier = trained_on(training, classifying);
  out.cases = fill_case_base(training, model, classifying);
  std::vector<MonitoredRun> checks =
      runs_of(faults(options.validation_per_label), kValidationSeeds, part_of(progress, kTrained, 1.0), {})
          .runs;
  Validated validated =
      validate(checks, runs_of(calm, kHealthyValidationSeeds, {}, {}).runs, model, out.cases);
  model.validation = std::move(validated.validation);
  model.confidence = calibrate_confidence(validated.judged);
  runs.erase(runs.begin() + static_cast<std::ptrdiff_t>(simulated), runs.end());
  std::move(checks.begin(), checks.end(), std::back_inserter(runs));
  model.validation.reach = detectability_of(runs, least_found_in(days, model, options.threads));
}

Learned learn_tracking_alone(std::span<LogSource* const> healthy, std::span<const LabelledLog> labelled,
                             const Robot& robot, double alarms_per_hour, const Progress& progress) {
  if (!labelled.empty())
    throw Error(ErrorCode::input, labelled.front().log->identity().path,
                "is labelled with a fault, but the healthy logs have no torque: a model without torque "
                "learns healthy motion only; leave labelled logs out");
  if (progress) progress("learning how joints follow their references", 0.0);
  Learned out;
  out.model = tracking_model(healthy, robot, alarms_per_hour);
  bind_cases(out.model, out.cases);
  return out;
}

/// The same callback with shares that never fall: what is learned again, without a log that contradicts the
/// others, does not take the share back.
Progress never_falling(const Progress& progress) {
  if (!progress) return {};
  return [progress, highest = 0.0](const std::string& what, double share) mutable {
    highest = std::max(highest, share);
    progress(what, highest);
  };
}

}  // namespace

void LearnOptions::check() const {
  identify.check();
  twin.check();
  auto at_least = [](const char* name, int value, int bound) {
    if (value < bound)
      throw Error(ErrorCode::usage, name,
                  "is " + std::to_string(value) + ", must be at least " + std::to_string(bound));
  };
  if (!(alarms_per_hour >= kFewestAlarms && alarms_per_hour <= kMostAlarms))
    throw Error(ErrorCode::usage, "alarms_per_hour",
                fmt::format("is {}, must be between {} and {}", alarms_per_hour, kFewestAlarms, kMostAlarms));
  at_least("runs_per_label", runs_per_label, 2);
  at_least("validation_per_label", validation_per_label, 0);
  at_least("healthy_runs", healthy_runs, 0);
  at_least("threads", threads, 0);
}

Learned learn(std::span<LogSource* const> healthy, std::span<const LabelledLog> labelled, const Robot& robot,
              const LearnOptions& options, const Progress& reported) {
  options.check();
  const Progress progress = never_falling(reported);
  std::deque<EmptyRowsSource> filled;  // an empty row for each that was lost, as diagnose() reads them
  for (LogSource* log : healthy) filled.emplace_back(*log);
  const std::vector<LogSource*> filled_logs = pointers(filled);
  RememberedLogs logs(filled_logs);
  ModelCaveats doubts{implausible_units(logs.sources(), robot), {}, {}};
  if (!options.keep_doubtful) refuse_grave(doubts);
  if (lack_torque(logs.sources()))
    return learn_tracking_alone(logs.sources(), labelled, robot, options.alarms_per_hour, progress);
  ExplainedRobot explained = consistent_robot(logs.sources(), robot,
                                              {.identify = options.identify,
                                               .limit_shift = limit_shift(options.alarms_per_hour),
                                               .threads = options.threads},
                                              part_of(progress, 0.0, kIdentified));
  HealthyRobot& found = explained.robot;
  doubts.add(caveats_of(found.identification));
  doubts.add({{}, explained.doubts, {}});
  if (!options.keep_doubtful) refuse_grave(doubts);
  Learned out;
  Model& model = out.model;
  out.identification = std::move(found.identification);
  model = std::move(found.model);
  const std::vector<LogSource*> acting = pointers(found.logs);
  out.residual =
      learn_residual_generator(acting, model.robot, model.robot.torque_phi.value_or(0.0), options.residual,
                               part_of(progress, kIdentified, kResidualsLearned));
  model.residual = out.residual.generator;
  model.has_velocity = !model.residual.shape.derive_velocity;
  learn_from_twin(out, labelled, found.conversion, explained.logs, options, progress);
  model.relations =
      learn_relations(acting, {.torque_is_commanded = model.robot.log.torque == TorqueMeaning::commanded,
                               .period_s = model.sample_period_s,
                               .least_share = model.robot.normal.model_error,
                               .torque_offset = model.robot.normal.torque_offset,
                               .alarms_per_hour = options.alarms_per_hour,
                               .torque_gain = model.robot.normal.torque_constant});
  doubts.add(caveats_of(model.validation, !model.relations.empty()));
  if (!options.keep_doubtful) refuse_grave(doubts);
  model.doubts = listed(doubts);
  model.grave_doubts = against_healthy(doubts);
  model.sources = sources_of(found.given, labelled);
  model.twin = options.twin;
  bind_cases(model, out.cases);
  return out;
}

}  // namespace faultline
