// SPDX-License-Identifier: MIT
#include "lib/reproduce/protocol/protocol.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "lib/core/random.hpp"
#include "lib/simulate/simulate.hpp"

namespace faultline {
namespace {

constexpr double kIntegrationStep = 0.0074;  // s; the bench robot without friction is smooth
constexpr double kPdBandwidth = 5.0;         // rad/s: settles within a move of 1.2 to 1.8 s

SimulationSpec spec_of(ControllerVariant controller, double duration_s) {
  SimulationSpec spec;
  spec.duration_s = duration_s;
  spec.sample_period_s = kSamplePeriod;
  spec.control_period_s = controller == ControllerVariant::held ? kSamplePeriod : kControlPeriod;
  spec.max_step_s = kIntegrationStep;
  spec.motion.dwell_min_s = 0.0;
  spec.motion.dwell_max_s = 0.4;
  spec.controller = controller_spec(controller);
  if (controller == ControllerVariant::pd) spec.motion.profile = MotionProfile::step;
  return spec;
}

void set_fault(SimulationSpec& spec, const ActingFault& fault, double lead_s) {
  if (fault.label.kind != FaultKind::none)
    spec.faults = {{.kind = fault.label.kind, .joint = fault.label.joint, .onset_s = lead_s + fault.onset_s}};
}

std::vector<double> random_point(Random& random) {
  return {random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), random.uniform(-0.35, 0.05)};
}

double half_range(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return 0.5 * (*high - *low);
}

void add_noise(std::vector<double>& signal, double std, Random& random) {
  for (double& value : signal) value += std * random.normal();
}

constexpr int kEndOfClass[kFaultClasses] = {20, 40, 75, kTable1Trajectories};

}  // namespace

const char* to_string(ControllerVariant controller) {
  static constexpr std::array kNames{"held", "fast", "pd"};
  static_assert(kNames.size() == static_cast<std::size_t>(ControllerVariant::pd) + 1);
  return kNames[static_cast<std::size_t>(controller)];
}

ControllerSpec controller_spec(ControllerVariant controller) {
  if (controller != ControllerVariant::pd) return {};
  return {.kind = ControllerKind::pd_gravity, .bandwidth_rad_s = kPdBandwidth};
}

Robot bench_robot() {
  Robot robot = preset_robot("RRP");
  robot.name = "bench";
  robot = with_masses_and_lengths(std::move(robot), {1.0, 0.8, 0.5}, {1.0, 0.8, 0.0});
  robot.log.torque_between_samples = TorqueTiming::held;
  robot.identified = true;
  return robot;
}

Robot bench_robot_with_friction() {
  Robot robot = bench_robot();
  robot.name = "bench with friction";
  const double viscous[] = {0.6, 0.4, 2.0}, coulomb[] = {0.8, 0.5, 2.0};  // N m s/rad, N s/m; N m, N
  for (int j = 0; j < 3; ++j) {
    robot.chain.friction[j].viscous = viscous[j];
    robot.chain.friction[j].coulomb = coulomb[j];
  }
  return robot;
}

Eigen::VectorXd HalfRanges::state() const {
  Eigen::VectorXd half(q.size() + dq.size());
  half << q, dq;
  return half;
}

HalfRanges half_ranges(const Robot& robot, ControllerVariant controller) {
  Log log;
  for (int i = 0; i < 100; ++i)
    append(log, trajectory(robot, controller, 25, seed_of(1, SeedUse::ranges, i)));
  HalfRanges ranges{Eigen::Vector3d(2.0, 2.0, 0.2), Eigen::VectorXd(3), Eigen::VectorXd(3)};
  for (int j = 0; j < 3; ++j) {
    ranges.dq[j] = half_range(log.dq[j]);
    ranges.tau[j] = half_range(log.tau[j]);
  }
  return ranges;
}

Experiment experiment_on(const Robot& robot, ControllerVariant controller, std::uint64_t seed) {
  return {robot, controller, half_ranges(robot, controller), seed};
}

Log trajectory(const Robot& robot, ControllerVariant controller, int samples, std::uint64_t seed,
               const ActingFault& fault) {
  // A step is a step only from somewhere: one sample of rest before it, which is cut off again.
  const int lead = controller == ControllerVariant::pd ? 1 : 0;
  const double lead_s = lead * kSamplePeriod;
  SimulationSpec spec = spec_of(controller, lead_s + samples * kSamplePeriod);
  Random random = Random::stream(seed, 2);
  const std::vector<double> from = random_point(random), to = random_point(random);
  spec.motion.points = {from, to, to};  // one move, then rest
  spec.motion.dwell_min_s = spec.motion.dwell_max_s = lead_s;
  set_fault(spec, fault, lead_s);
  const Log log = simulate(robot, spec, seed).log;
  Log kept = slice(log, lead, log.rows());
  kept.first_row = 0;
  for (double& time : kept.time) time -= lead_s;
  return kept;
}

Log run_of_moves(const Robot& robot, ControllerVariant controller, const RunOfMoves& run,
                 std::uint64_t seed) {
  SimulationSpec spec = spec_of(controller, run.duration_s);
  spec.sample_period_s = run.sample_period_s;
  set_fault(spec, run.fault, 0.0);
  return simulate(robot, spec, seed).log;
}

double share_with_a_start() {
  const MotionSpec motion = spec_of(ControllerVariant::pd, 0.0).motion;
  const double move_s = 0.5 * (motion.move_min_s + motion.move_max_s);
  const double rest_s = 0.5 * (motion.dwell_min_s + motion.dwell_max_s);
  return kSamplePeriod / (move_s + rest_s);
}

void add_noise(Log& log, const HalfRanges& ranges, double sigma, std::uint64_t seed) {
  if (sigma <= 0.0) return;
  Random random = Random::stream(seed, 1);
  for (int j = 0; j < log.joints(); ++j) {
    add_noise(log.q[j], sigma * ranges.q[j], random);
    add_noise(log.dq[j], sigma * ranges.dq[j], random);
  }
}

TransitionShape one_sample(int joints, double torque_phi) {
  return {.joints = joints, .step = 1, .stride = 1, .step_s = kSamplePeriod, .torque_phi = torque_phi};
}

Transitions transitions_of(const std::vector<Log>& logs, double torque_phi) {
  Transitions all;
  for (const Log& log : logs) {
    TransitionState state;
    Transitions next = collect_transitions(log, one_sample(log.joints(), torque_phi), state);
    all = all.count() == 0 ? std::move(next) : joined(all, next);
  }
  return all;
}

std::uint64_t seed_of(std::uint64_t seed, SeedUse use, std::uint64_t index) {
  return Random::stream(Random::stream(seed, static_cast<std::uint64_t>(use)).bits(), index).bits();
}

int table_1_class(int index) {
  int output = 0;
  while (index >= kEndOfClass[output]) ++output;
  return output;
}

FaultLabel fault_of_class(int output) {
  if (output == kFaultClasses - 1) return {};
  return {FaultKind::free_swinging, Joint::at(output)};
}

Eigen::Vector4d table_1_prior() {
  Eigen::Vector4d prior = Eigen::Vector4d::Zero();
  for (int i = 0; i < kTable1Trajectories; ++i) prior[table_1_class(i)] += 1.0 / kTable1Trajectories;
  return prior;
}

int FaultPatterns::count() const {
  int sum = 0;
  for (const Transitions& transitions : of_class) sum += transitions.count();
  return sum;
}

FaultPatterns fault_patterns(const Experiment& experiment, const FaultTrajectories& trajectories,
                             SeedUse use) {
  std::array<std::vector<Log>, kFaultClasses> logs;
  for (int i = 0; i < trajectories.count; ++i) {
    const std::uint64_t own = seed_of(experiment.seed, use, i);
    const int output = table_1_class(i * kTable1Trajectories / trajectories.count);
    Log log = trajectory(experiment.robot, experiment.controller, kPatternsPerTrajectory, own,
                         {fault_of_class(output)});
    add_noise(log, experiment.ranges, trajectories.sigma, own);
    logs[output].push_back(std::move(log));
  }
  FaultPatterns patterns;
  for (int output = 0; output < kFaultClasses; ++output)
    patterns.of_class[output] = transitions_of(logs[output], trajectories.torque_phi);
  return patterns;
}

}  // namespace faultline
