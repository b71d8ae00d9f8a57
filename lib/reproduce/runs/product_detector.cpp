// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/product_detector.hpp"

#include <algorithm>

#include "lib/classify/episode_features.hpp"
#include "lib/diagnosis/decide_episode.hpp"
#include "lib/diagnosis/describe_episode.hpp"
#include "lib/evidence/usual_motion.hpp"
#include "lib/log/memory_source.hpp"
#include "lib/monitor/monitor.hpp"
#include "lib/reproduce/filter/match_noise.hpp"

namespace faultline {
namespace {

constexpr int kHealthyLogs = 3;
constexpr std::uint64_t kDetectorNoise = 100;
constexpr int kMatchedRows = 2000;
constexpr int kHealthyRuns = 10;      // simulated to calibrate the threshold
constexpr double kLeastSigma = 1e-5;  // a filter needs some measurement noise
constexpr double kSafety = 1.25;      // other days are worse than those that the noise was matched to
// Floors that keep a model of perfect logs from trusting itself too much.
constexpr double kLeastTorqueShare = 0.003, kLeastRestShare = 0.05;

/// Healthy logs as the stages read them.
class Sources {
 public:
  explicit Sources(const HealthyLogs& healthy) {
    for (const Log& log : healthy.logs) sources_.emplace_back(log, "healthy");
    for (MemorySource& source : sources_) pointers_.push_back(&source);
  }
  const std::vector<LogSource*>& all() const { return pointers_; }

 private:
  std::vector<MemorySource> sources_;
  std::vector<LogSource*> pointers_;
};

/// With noise of a tenth of the range shooting creeps on for long without a gain that the filters feel.
IdentifyOptions identify_options() {
  IdentifyOptions options;
  options.threads = 1;
  options.max_iterations = 12;
  return options;
}

bool is_held(const Robot& robot) { return robot.log.torque_between_samples == TorqueTiming::held; }

}  // namespace

HealthyLogs healthy_logs(const Experiment& experiment, double duration_s, double sigma) {
  const auto& [robot, controller, ranges, seed] = experiment;
  HealthyLogs healthy;
  for (std::uint64_t i = 0; i < kHealthyLogs; ++i) {
    healthy.logs.push_back(
        run_of_moves(robot, controller, {duration_s}, seed_of(seed, SeedUse::learning_logs, i)));
    add_noise(healthy.logs.back(), ranges, sigma, seed_of(seed, SeedUse::learning_logs, kDetectorNoise + i));
  }
  healthy.robot = preset_robot(robot.axes);
  healthy.robot.name = robot.name;
  healthy.robot.known["l1"] = {robot.chain.length[0], 0.0};
  healthy.robot.log.torque_between_samples =
      controller == ControllerReading::held ? TorqueTiming::held : TorqueTiming::unknown;
  return healthy;
}

Learned learn_product(const HealthyLogs& healthy, bool quick, std::uint64_t seed) {
  LearnOptions options;
  options.threads = 1;
  options.identify = identify_options();
  options.runs_per_label = 4;
  options.validation_per_label = 0;
  options.healthy_runs = quick ? 4 : kHealthyRuns;
  options.residual.max_iterations = quick ? 8 : 30;
  if (quick) options.residual.max_patterns = 600;
  if (quick) options.kinds = {FaultKind::free_swinging, FaultKind::torque_loss, FaultKind::locked};
  options.seed = seed;
  const Sources sources(healthy);
  return learn(sources.all(), {}, healthy.robot, options);
}

Identification identify_robot(const HealthyLogs& healthy) {
  const Sources sources(healthy);
  return identify(sources.all(), healthy.robot, identify_options());
}

MotionModel motion_model_of(const Chain<double>& chain, const HealthyLogs& healthy, const HalfRanges& ranges,
                            double sigma) {
  IdentifiedMotion motion;
  motion.chain = chain;
  motion.torque_is_held = is_held(healthy.robot);
  motion.torque_phi = motion.torque_is_held ? 0.0 : 0.5;
  for (int j = 0; j < chain.joints(); ++j) {
    motion.q_std.push_back(std::max(sigma, kLeastSigma) * ranges.q[j]);
    motion.dq_std.push_back(std::max(sigma, kLeastSigma) * ranges.dq[j]);
  }
  const Sources sources(healthy);
  MotionModel model = usual_motion(sources.all(), motion);
  std::vector<HealthyExcerpt> excerpts;
  const int each = kMatchedRows / static_cast<int>(healthy.logs.size());
  for (const Log& log : healthy.logs) excerpts.push_back({slice(log, 0, std::min(log.rows(), each))});
  match_noise(model, excerpts, {.held = motion.torque_is_held, .threads = 1});
  ProcessNoise& noise = model.noise;
  noise.torque_share = std::max(kSafety * noise.torque_share, kLeastTorqueShare);
  noise.rest_share = std::max(kSafety * noise.rest_share, kLeastRestShare);
  noise.step_share *= kSafety;
  for (double& floor : noise.floor) floor *= kSafety;
  return model;
}

ProductAlarms product_alarms(const Learned& learned, const Log& log) {
  const Model& model = learned.model;
  MemorySource source(log, "run");
  ProductAlarms alarms;
  for (const MonitoredEpisode& observed : monitor(source, model).episodes) {
    const double alarm_s = observed.alarm_s();
    const Episode episode = describe_episode(observed, model).episode;
    alarms.mlp.push_back({alarm_s, episode.mlp.label});
    alarms.rbfn.push_back({alarm_s, episode.rbfn.label});
    alarms.cases.push_back({alarm_s, decide_episode(observed, model, learned.cases).label});
  }
  return alarms;
}

}  // namespace faultline
