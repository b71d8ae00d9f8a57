// SPDX-License-Identifier: MIT
#include "lib/pipeline/learn.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include "lib/classify/episode_features.hpp"
#include "lib/core/error.hpp"
#include "lib/diagnosis/decide_episode.hpp"
#include "lib/evidence/learn_motion_model.hpp"
#include "lib/pipeline/learn_samples.hpp"
#include "lib/pipeline/twin_study.hpp"

namespace faultline {
namespace {

constexpr double kCalmMargin = 1.3;  // the threshold lies this much above what healthy twins reach
constexpr double kMostRaised = 2.0;
constexpr int kSampleRunsPerLabel = 6;  // of the paper's classifiers, two thirds for training
constexpr int kHealthySampleRuns = 24;

// Streams of seeds that never meet.
constexpr std::uint64_t kTrainingSeeds = 0, kValidationSeeds = 1'000'000, kHealthySeeds = 2'000'000,
                        kHealthyValidationSeeds = 3'000'000, kSampleSeeds = 4'000'000,
                        kSeedBlock = 10'000'000;

IdentifiedMotion identified_motion(const Identification& identification) {
  IdentifiedMotion motion;
  motion.chain = identification.robot.chain;
  motion.torque_phi = identification.robot.torque_phi.value_or(0.0);
  motion.torque_is_held = identification.robot.log.torque_between_samples == TorqueTiming::held;
  motion.q_std = identification.q_noise;
  motion.dq_std = identification.dq_noise;
  if (motion.dq_std.empty()) motion.dq_std.assign(motion.q_std.size(), 1.0);
  return motion;
}

double usual_period_s(const Identification& identification) {
  std::vector<double> periods;
  for (const IdentifiedLog& log : identification.logs) periods.push_back(log.sample_period_s);
  std::sort(periods.begin(), periods.end());
  return periods.empty() ? 0.0 : periods[periods.size() / 2];
}

std::vector<ModelSource> sources_of(const Identification& identification,
                                    std::span<const LabelledLog> labelled) {
  std::vector<ModelSource> sources;
  for (const IdentifiedLog& log : identification.logs)
    sources.push_back({std::filesystem::path(log.path).filename().string(), log.sha256, log.rows, "none"});
  for (const LabelledLog& log : labelled)
    sources.push_back({std::filesystem::path(log.log->identity().path).filename().string(),
                       log.log->identity().sha256, log.log->identity().rows_read, to_string(log.label.kind)});
  return sources;
}

/// What a model keeps of the identification for those who ask how good it is.
Identification without_state(Identification identification) {
  identification.robot = {};
  identification.space = {};
  identification.estimate = {};
  identification.covariance = {};
  identification.logs.clear();  // the model's sources name them
  return identification;
}

/// Every label the bank can name `count` times: of the kinds asked for, all if none is; joint by joint.
std::vector<FaultLabel> labels_to_simulate(const std::vector<Hypothesis>& bank, int count,
                                           const std::vector<FaultKind>& kinds) {
  std::vector<FaultLabel> labels;
  for (const FaultLabel& label : labels_of(bank).labels) {
    const bool wanted = kinds.empty() || std::find(kinds.begin(), kinds.end(), label.kind) != kinds.end();
    if (wanted && label.kind != FaultKind::unknown && label.joint > 0)
      labels.insert(labels.end(), count, label);
  }
  return labels;
}

std::vector<HeardRun> hear_labelled(std::span<const LabelledLog> labelled, const Model& model) {
  std::vector<HeardRun> runs;
  for (const LabelledLog& entry : labelled) {
    entry.log->rewind();
    runs.push_back({entry.label, entry.onset_s, 0.0, listen(*entry.log, model)});
  }
  return runs;
}

/// The training episodes of runs, with the run each came from.
struct TrainingEpisodes {
  std::vector<LabelledEpisode> episodes;
  std::vector<const HeardRun*> runs;
  std::vector<int> index;  ///< of the episode in its run
};

TrainingEpisodes training_episodes(const std::vector<HeardRun>& runs, const Model& model) {
  TrainingEpisodes out;
  for (const HeardRun& run : runs) {
    const int i = episode_of_fault(run);
    if (i < 0) continue;
    const Episode episode = episode_of(run.heard.episodes[i], run.heard.episode_residuals[i], model);
    out.episodes.push_back({episode.features, run.label});
    out.runs.push_back(&run);
    out.index.push_back(i);
  }
  return out;
}

/// A case an episode. The opinions kept with it come from judges that were trained on the other half of the
/// episodes, so that they are as good as they will be in use, not better.
CaseBase fill_case_base(const TrainingEpisodes& training, const Model& model, const JudgeOptions& options) {
  CaseBase cases(episode_feature_names(model.bank, model.robot.joints()));
  std::array<Judges, 2> half;
  for (int h = 0; h < 2; ++h) {
    std::vector<LabelledEpisode> others;
    for (std::size_t i = 0; i < training.episodes.size(); ++i)
      if (static_cast<int>(i % 2) != h) others.push_back(training.episodes[i]);
    half[h] = train_judges(others, options);
  }
  for (std::size_t i = 0; i < training.episodes.size(); ++i) {
    Case c;
    const EpisodeEvidence& episode = training.runs[i]->heard.episodes[training.index[i]];
    const JudgeOpinions opinions = judge(half[i % 2], training.episodes[i].features);
    c.episode.features = training.episodes[i].features;
    c.episode.mlp = {opinions.mlp.label, opinions.mlp.confidence};
    c.episode.rbfn = {opinions.rbfn.label, opinions.rbfn.confidence};
    c.episode.evidence = episode.hypotheses[episode.best].log_likelihood_ratio;
    c.decision = c.label = training.episodes[i].label;
    c.outcome = CaseOutcome::confirmed;
    c.origin = training.runs[i]->length_s > 0.0 ? "simulated" : "labelled log";
    cases.retain(std::move(c));
  }
  cases.learn();
  return cases;
}

/// Raises the threshold above what simulated healthy runs reach, but not to where it would hide faults
/// because a controller of the twin went astray; the false alarms of the validation tell whether that was
/// enough.
void calibrate_on_twin(Model& model, const std::vector<HeardRun>& healthy) {
  double largest = 0.0;
  for (const HeardRun& run : healthy) {
    largest = std::max(largest, run.heard.largest_ratio);
    for (const EpisodeEvidence& episode : run.heard.episodes)
      largest = std::max(largest, episode.hypotheses[episode.best].log_likelihood_ratio);
  }
  const double wanted = std::min(kCalmMargin * largest, kMostRaised * model.evidence.threshold);
  model.evidence.threshold = std::max(model.evidence.threshold, wanted);
}

}  // namespace

void LearnOptions::check() const {
  identify.check();
  twin.check();
  auto at_least = [](const char* name, int value, int bound) {
    if (value < bound)
      throw Error(ErrorCode::usage, std::string("LearnOptions.") + name,
                  "is " + std::to_string(value) + ", must be at least " + std::to_string(bound));
  };
  at_least("runs_per_label", runs_per_label, 4);
  at_least("validation_per_label", validation_per_label, 0);
  at_least("healthy_runs", healthy_runs, 0);
  at_least("threads", threads, 0);
}

Learned learn(std::span<LogSource* const> healthy, std::span<const LabelledLog> labelled, const Robot& robot,
              const LearnOptions& options, const Progress& progress) {
  options.check();
  Learned out;
  Model& model = out.model;
  out.identification = identify(healthy, robot, options.identify, part_of(progress, 0.0, 0.25));
  model.robot = out.identification.robot;
  model.identification = without_state(out.identification);
  model.name = robot.name;
  model.sample_period_s = usual_period_s(out.identification);
  model.has_velocity = !out.identification.dq_noise.empty();
  model.bank = hypotheses_of(model.robot.joints(), model.robot.log.torque);

  out.residual = learn_residual_generator(healthy, model.robot, model.robot.torque_phi.value_or(0.0),
                                          options.residual, part_of(progress, 0.25, 0.35));
  model.residual = out.residual.generator;
  model.motion = learn_motion_model(healthy, identified_motion(out.identification), {});
  model.evidence = calibrate_thresholds(healthy, model.motion, model.bank, {});

  const Twin twin{&out.identification, &model.motion, model.sample_period_s, model.has_velocity,
                  options.twin};
  const std::uint64_t seed = options.seed * kSeedBlock;
  const std::vector<FaultLabel> calm(options.healthy_runs, FaultLabel{});
  calibrate_on_twin(model, hear_twin_runs(twin, model, calm, seed + kHealthySeeds, options.threads, {}));
  std::vector<HeardRun> runs =
      hear_twin_runs(twin, model, labels_to_simulate(model.bank, options.runs_per_label, options.kinds),
                     seed + kTrainingSeeds, options.threads, part_of(progress, 0.4, 0.8));
  for (HeardRun& run : hear_labelled(labelled, model)) runs.push_back(std::move(run));

  const TrainingEpisodes training = training_episodes(runs, model);
  JudgeOptions judging;
  judging.seed = options.seed;
  model.judges = train_judges(training.episodes, judging);
  out.cases = fill_case_base(training, model, judging);
  std::vector<FaultLabel> sample_labels = labels_to_simulate(model.bank, kSampleRunsPerLabel, options.kinds);
  std::erase_if(sample_labels,
                [](const FaultLabel& label) { return !describe(label.kind).shows_in_each_sample; });
  sample_labels.insert(sample_labels.end(), kHealthySampleRuns, FaultLabel{});
  model.samples = learn_sample_mode(twin, model, sample_labels, seed + kSampleSeeds, options.threads);
  model.validation = validate(
      hear_twin_runs(twin, model, labels_to_simulate(model.bank, options.validation_per_label, options.kinds),
                     seed + kValidationSeeds, options.threads, part_of(progress, 0.85, 1.0)),
      hear_twin_runs(twin, model, calm, seed + kHealthyValidationSeeds, options.threads, {}), model,
      out.cases);
  model.sources = sources_of(out.identification, labelled);
  return out;
}

}  // namespace faultline
