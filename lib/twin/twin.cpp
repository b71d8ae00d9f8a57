// SPDX-License-Identifier: MIT
#include "lib/twin/twin.hpp"

#include <algorithm>
#include <cmath>

#include "lib/evidence/size_scale.hpp"

namespace faultline {
namespace {

constexpr double kControlPeriod_s = 0.001;  // of robots whose torque changes between samples
constexpr double kPdShare = 0.25;           // of runs controlled by PD, the rest by computed torque
constexpr double kModelError = 0.05;        // the controller's model is off by up to this
constexpr double kStopShare = 0.6;          // of runs with end stops somewhere outside the range seen
constexpr double kTripSpeed = 12.0;         // of the usual speed
constexpr double kEverywhereShare = 0.4;    // of collisions that push a second joint too

constexpr int kMostAttempts = 4;  // controllers are drawn until one holds the robot up to the onset
constexpr std::uint64_t kAttemptSeeds = 500'000'000'000;

double log_uniform(Random& random, double low, double high) {
  return low * std::exp(random.uniform() * std::log(high / low));
}

double random_sign(Random& random) { return random.uniform() < 0.5 ? -1.0 : 1.0; }

double draw(const DrawRange& range, double scale, Random& random) {
  const double sign = range.either_sign ? random_sign(random) : 1.0;
  const double share = range.spread == Spread::log_uniform ? log_uniform(random, range.low, range.high)
                                                           : random.uniform(range.low, range.high);
  return sign * share * scale;
}

/// Length of a move over which the twin is about as fast as the logs: a quintic over a third of the range has
/// an rms speed of 1.2 times its mean.
double usual_move_s(const MotionModel& motion) {
  std::vector<double> lengths;
  for (int j = 0; j < motion.joints(); ++j)
    if (motion.velocity_scale[j] > 0.0)
      lengths.push_back(0.4 * (motion.q_high[j] - motion.q_low[j]) / motion.velocity_scale[j]);
  if (lengths.empty()) return 1.0;
  std::nth_element(lengths.begin(), lengths.begin() + lengths.size() / 2, lengths.end());
  return std::clamp(lengths[lengths.size() / 2], 0.3, 10.0);
}

MotionSpec motion_spec(const Twin& twin, Random& random) {
  MotionSpec spec;
  spec.profile = random.uniform() < 0.5 ? MotionProfile::quintic : MotionProfile::trapezoidal;
  spec.low = twin.motion->q_low;
  spec.high = twin.motion->q_high;
  const double move_s = usual_move_s(*twin.motion);
  spec.move_min_s = 0.8 * move_s;
  spec.move_max_s = 1.3 * move_s;
  spec.dwell_min_s = 0.05 * move_s;
  spec.dwell_max_s = 0.4 * move_s;
  return spec;
}

ControllerSpec controller_spec(int joints, bool allow_pd, Random& random) {
  ControllerSpec spec;
  const bool pd = random.uniform() < kPdShare;
  spec.kind = pd && allow_pd ? ControllerKind::pd_gravity : ControllerKind::computed_torque;
  for (int j = 0; j < joints; ++j) spec.mass_error.push_back(random.uniform(-kModelError, kModelError));
  return spec;
}

JointStops stops_outside(const MotionModel& motion, Random& random) {
  JointStops stops;
  for (int j = 0; j < motion.joints(); ++j) {
    const double range = motion.q_high[j] - motion.q_low[j];
    stops.low.push_back(motion.q_low[j] - random.uniform(0.05, 0.6) * range);
    stops.high.push_back(motion.q_high[j] + random.uniform(0.05, 0.6) * range);
  }
  return stops;
}

double control_period_s(const Twin& twin) {
  const bool held = twin.identification->robot.log.torque_between_samples == TorqueTiming::held;
  if (held || twin.sample_period_s <= kControlPeriod_s) return twin.sample_period_s;
  return twin.sample_period_s / std::round(twin.sample_period_s / kControlPeriod_s);
}

/// Sizes that a technician would call a fault, against what is usual for the joint.
FaultEvent fault_event(const Twin& twin, const FaultLabel& label, double onset_s, Random& random) {
  const MotionModel& motion = *twin.motion;
  FaultEvent fault;
  fault.kind = label.kind;
  fault.joint = label.joint;
  fault.onset_s = onset_s;
  const std::span<const FaultSize> sizes = describe(label.kind).sizes();
  auto drawn = [&](const FaultSize& size) {
    return draw(size.twin, usual_size(motion, size.measure, label.joint - 1), random);
  };
  if (!sizes.empty()) fault.size = drawn(sizes.back());
  if (sizes.size() > 1) fault.viscous = drawn(sizes.front());
  if (describe(label.kind).passes) {
    const double length_s = draw(describe(label.kind).twin_length_s, 1.0, random);
    fault.end_s = onset_s + std::max(length_s, twin.sample_period_s);
  }
  return fault;
}

/// A contact at the tip pushes another joint as well, less than its own.
void push_another_joint(const MotionModel& motion, std::vector<FaultEvent>& faults, Random& random) {
  const int joints = motion.joints();
  if (joints < 2 || random.uniform() > kEverywhereShare) return;
  FaultEvent other = faults.front();
  const int first = other.joint - 1;
  const int second = (first + 1 + static_cast<int>(random.below(joints - 1))) % joints;
  const double share = random.uniform(0.2, 0.8) * random_sign(random);
  other.joint = second + 1;
  other.size = share * faults.front().size / motion.torque_scale[first] * motion.torque_scale[second];
  faults.push_back(other);
}

/// One try; the run may end early when the controller drawn does not hold this robot.
TwinRun try_twin_run(const Twin& twin, const FaultLabel& label, std::uint64_t seed, int attempt) {
  Random random = Random::stream(seed, 7 + static_cast<std::uint64_t>(attempt));
  const Robot robot = draw(*twin.identification, random);
  const MotionModel& motion = *twin.motion;
  SimulationSpec spec;
  spec.duration_s = twin_run_length_s(twin);
  spec.sample_period_s = twin.sample_period_s;
  spec.control_period_s = control_period_s(twin);
  spec.max_step_s = std::max(kControlPeriod_s, 0.1 * spec.control_period_s);
  spec.motion = motion_spec(twin, random);
  spec.controller = controller_spec(robot.joints(), attempt == 0, random);
  spec.noise.q = twin.identification->q_noise;
  spec.noise.dq = twin.identification->dq_noise;
  for (const double speed : motion.velocity_scale) spec.overspeed.push_back(kTripSpeed * speed);
  if (random.uniform() < kStopShare) spec.stops = stops_outside(motion, random);
  TwinRun run;
  run.label = label;
  run.onset_s = spec.duration_s;
  if (label.kind != FaultKind::none) {
    run.onset_s = random.uniform(0.25, 0.7) * spec.duration_s;
    spec.faults.push_back(fault_event(twin, label, run.onset_s, random));
    run.end_s = spec.faults.front().end_s;
    if (describe(label.kind).passes) push_another_joint(motion, spec.faults, random);
  }
  run.log = simulate(robot, spec, seed + static_cast<std::uint64_t>(attempt) * kAttemptSeeds).log;
  if (!twin.has_velocity) run.log.dq.clear();
  return run;
}

}  // namespace

double twin_run_length_s(const Twin& twin) {
  return std::max({5.0, 4.0 * usual_move_s(*twin.motion), 150.0 * twin.sample_period_s});
}

TwinRun twin_run(const Twin& twin, const FaultLabel& label, std::uint64_t seed) {
  TwinRun run;
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    run = try_twin_run(twin, label, seed, attempt);
    const double needed_s = run.onset_s + (label.kind == FaultKind::none ? -2.0 : 3.0) * twin.sample_period_s;
    if (run.log.rows() > 0 && run.log.time.back() >= needed_s) break;
  }
  return run;
}

}  // namespace faultline
