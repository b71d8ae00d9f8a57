// SPDX-License-Identifier: MIT
#include "lib/learn/twin.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/statistics.hpp"
#include "lib/identify/feasible/feasible.hpp"
#include "lib/simulate/mobility.hpp"

namespace faultline {
namespace {

// Disjoint streams of random numbers: of the draws of attempts, and of their simulations.
constexpr std::uint64_t kDrawStream = 7;
constexpr std::uint64_t kAttemptSeeds = 500'000'000'000;  // more seeds than one learning uses

// Samples that a run must reach to be used: a few after the onset, or nearly all of a healthy one.
constexpr double kNeededAfterOnset = 3.0;  // after the onset
constexpr double kSpareAtTheEnd = 2.0;     // before the end of a healthy run

/// Duration of a usual move over range / rms speed: a move between random points goes over a third of the
/// range, and a quintic has an rms speed of 1.2 times its mean.
constexpr double kMoveShare = 0.4;
constexpr double kMoveOfAStill_s = 1.0;  // duration of the usual move if no joint of the logs moves

constexpr double kLeastDeviation = 0.01;  // share of the uncertainty: below, the estimate itself is used
constexpr double kMostStds = 2.0;         // standard deviations of an effect of the day: the normal range
constexpr double kLeastFriction = 0.3;    // factor of the friction of a day: there is always some
constexpr double kSlowestFriction_s =
    5e-4;                            // time in which friction slows a joint: shorter changes no window
constexpr double kLeastGain = -0.9;  // change of the gain of a day: no drive reverses its torque

std::vector<double> scaled(std::vector<double> values, double by) {
  for (double& value : values) value *= by;
  return values;
}

double random_sign(Random& random) { return random.uniform() < 0.5 ? -1.0 : 1.0; }

/// Draws an effect of the day within the normal range; draws no random number if days do not differ.
double draw_change(double std, Random& random) {
  if (std == 0.0) return 0.0;
  const double most = kMostStds * std, change = std * random.normal();
  return std::clamp(change, -most, most);
}

double draw_from(const DrawRange& range, Random& random) {
  const double sign = range.either_sign ? random_sign(random) : 1.0;
  const double size =
      range.spread == Spread::log_uniform
          ? range.low * elementary::exp(random.uniform() * elementary::log(range.high / range.low))
          : random.uniform(range.low, range.high);
  return sign * size;
}

/// Draws a fault of sizes that a technician would call a fault, relative to what is usual for the joint.
SimulatedFault draw_fault(const Twin& twin, const FaultLabel& label, double onset_s, Random& random) {
  const TwinFault& ranges = twin.options.faults[static_cast<std::size_t>(label.kind)];
  const FaultDescription& kind = describe(label.kind);
  SimulatedFault fault;
  fault.kind = label.kind;
  fault.joint = label.joint;
  fault.onset_s = onset_s;
  auto draw_size = [&](int s) {
    return draw_from(ranges.size[s], random) *
           usual_size(*twin.motion, kind.size[s].measure, label.joint.index());
  };
  if (kind.size_count > 0) fault.size = draw_size(kind.size_count - 1);
  if (kind.size_count > 1) fault.viscous = draw_size(0);
  if (kind.passes) fault.end_s = onset_s + std::max(draw_from(ranges.length_s, random), twin.sample_period_s);
  return fault;
}

/// The faults with a smaller push on another joint in a share of the runs, as a contact at the tip has.
std::vector<SimulatedFault> push_another_joint(const Twin& twin, std::vector<SimulatedFault> faults,
                                               Random& random) {
  const UsualMotion& motion = *twin.motion;
  const int joints = motion.joints();
  if (joints < 2 || random.uniform() > twin.options.second_push_share) return faults;
  SimulatedFault other = faults.front();
  const int first = other.joint.index();
  const int second = (first + 1 + static_cast<int>(random.below(joints - 1))) % joints;
  const double size = draw_from(twin.options.second_push, random);
  const double share = size * random_sign(random);
  other.joint = Joint::at(second);
  other.size = share * faults.front().size / motion.torque_scale[first] * motion.torque_scale[second];
  faults.push_back(other);
  return faults;
}

/// Duration of a move, s, at which the twin is about as fast as the logs.
double usual_move_s(const Twin& twin) {
  const UsualMotion& motion = *twin.motion;
  std::vector<double> lengths;
  for (int j = 0; j < motion.joints(); ++j)
    if (motion.velocity_scale[j] > 0.0)
      lengths.push_back(kMoveShare * (motion.q_high[j] - motion.q_low[j]) / motion.velocity_scale[j]);
  if (lengths.empty()) return kMoveOfAStill_s;
  return std::clamp(upper_median_of(lengths), twin.options.shortest_move_s, twin.options.longest_move_s);
}

MotionSpec draw_motion(const Twin& twin, Random& random) {
  MotionSpec spec;
  const bool quintic = random.uniform() < twin.options.quintic_share;
  spec.profile = quintic ? MotionProfile::quintic : MotionProfile::trapezoidal;
  spec.low = twin.motion->q_low;
  spec.high = twin.motion->q_high;
  const double move_s = usual_move_s(twin);
  spec.move_min_s = twin.options.move.low * move_s;
  spec.move_max_s = twin.options.move.high * move_s;
  spec.dwell_min_s = twin.options.dwell.low * move_s;
  spec.dwell_max_s = twin.options.dwell.high * move_s;
  return spec;
}

/// PD control stabilises fewer robots than computed torque, so that a second attempt does not allow it.
ControllerSpec draw_controller(const Twin& twin, bool allow_pd, Random& random) {
  ControllerSpec spec;
  const bool pd = random.uniform() < twin.options.pd_share;
  spec.kind = pd && allow_pd ? ControllerKind::pd_gravity : ControllerKind::computed_torque;
  const double most = twin.options.mass_error;
  for (int j = 0; j < twin.motion->joints(); ++j) spec.mass_error.push_back(random.uniform(-most, most));
  return spec;
}

/// Measurement noise of a day, within the normal range.
NoiseSpec draw_noise(const Twin& twin, Random& random) {
  const NoiseSpec noise{twin.identification->q_noise, twin.identification->dq_noise};
  const auto& [low, high] = twin.identification->robot.normal.noise;
  const double level = low * elementary::exp(random.uniform() * elementary::log(high / low));
  return {scaled(noise.q, level), scaled(noise.dq, level)};
}

/// Differences of drive torque and logged torque in the normal range: offset, torque constant, roughness.
DriveSpec draw_drives(const Twin& twin, Random& random) {
  const DayDifferences& days = twin.days;
  const auto joints = static_cast<std::size_t>(twin.motion->joints());
  DriveSpec drives;
  drives.roughness = days.missed;
  drives.roughness_memory_s = days.missed_memory_s;
  for (std::size_t j = 0; j < joints; ++j) {
    drives.offset.push_back(draw_change(days.offset[j], random));
    drives.gain.push_back(std::max(draw_change(days.gain[j], random), kLeastGain));
  }
  return drives;
}

/// Draws a robot from the uncertainty of the identification. Where the logs hardly determine an inertia, half
/// of such robots would be infeasible: the deviation is halved until the inertia matrix is positive definite.
Robot draw_robot(const Twin& twin, Random& random) {
  const UsualMotion& motion = *twin.motion;
  const Eigen::Map<const Eigen::VectorXd> low(motion.q_low.data(), motion.joints()),
      high(motion.q_high.data(), motion.joints());
  const Random before = random;
  for (double spread = 1.0; spread >= kLeastDeviation; spread *= 0.5) {
    random = before;
    Robot robot = draw(*twin.identification, random, spread);
    if (has_definite_inertia(robot.chain, low, high)) return robot;
  }
  random = before;
  return draw(*twin.identification, random, 0.0);
}

/// The robot with the friction of a day, within the normal range.
Robot draw_day(const Twin& twin, Robot robot, Random& random) {
  for (std::size_t j = 0; j < robot.chain.friction.size(); ++j) {
    const double scale = 1.0 + draw_change(twin.days.friction[j], random);
    const double excess = draw_change(twin.days.viscous_excess[j], random);
    robot.chain.friction[j].viscous *= std::max(scale + 0.5 * excess, kLeastFriction);
    robot.chain.friction[j].coulomb *= std::max(scale - 0.5 * excess, kLeastFriction);
    robot.chain.friction[j].load *= std::max(scale, kLeastFriction);
  }
  return robot;
}

/// End stops outside the range of the logs, or none.
JointStops draw_stops(const Twin& twin, Random& random) {
  JointStops stops;
  if (random.uniform() >= twin.options.stop_share) return stops;
  const UsualMotion& motion = *twin.motion;
  const DrawRange& distance = twin.options.stop_distance;
  for (int j = 0; j < motion.joints(); ++j) {
    const double range = motion.q_high[j] - motion.q_low[j];
    stops.low.push_back(motion.q_low[j] - draw_from(distance, random) * range);
    stops.high.push_back(motion.q_high[j] + draw_from(distance, random) * range);
  }
  return stops;
}

double control_period_s(const Twin& twin) {
  const double wanted = twin.options.control_period_s;
  const bool held = torque_between_samples(twin.identification->robot) == TorqueTiming::held;
  if (held || twin.sample_period_s <= wanted) return twin.sample_period_s;
  return twin.sample_period_s / std::round(twin.sample_period_s / wanted);
}

SimulationSpec spec_of(const Twin& twin, int attempt, Random& random) {
  SimulationSpec spec;
  spec.duration_s = twin_run_length_s(twin);
  spec.sample_period_s = twin.sample_period_s;
  spec.control_period_s = control_period_s(twin);
  spec.max_step_s =
      std::max(twin.options.control_period_s, twin.options.integration_share * spec.control_period_s);
  spec.motion = draw_motion(twin, random);
  spec.controller = draw_controller(twin, attempt == 0, random);
  spec.noise = draw_noise(twin, random);
  spec.drives = draw_drives(twin, random);
  for (const double speed : twin.motion->velocity_scale)
    spec.overspeed.push_back(twin.options.trip_speed * speed);
  spec.stops = draw_stops(twin, random);
  for (const double limit : twin.identification->robot.torque_limit)
    spec.torque_limit.push_back(limit > 0.0 ? limit : std::numeric_limits<double>::infinity());
  return spec;
}

/// Simulates one attempt; the run ends early if the drawn controller does not stabilise this robot.
TwinRun try_twin_run(const Twin& twin, const FaultLabel& label, std::uint64_t seed, int attempt) {
  Random random = Random::stream(seed, kDrawStream + static_cast<std::uint64_t>(attempt));
  Robot robot = draw_robot(twin, random);
  robot = with_slow_friction(draw_day(twin, std::move(robot), random), kSlowestFriction_s);
  SimulationSpec spec = spec_of(twin, attempt, random);
  TwinRun run;
  run.label = label;
  run.onset_s = spec.duration_s;
  if (label.kind != FaultKind::none) {
    const DrawRange& onset = twin.options.onset;
    run.onset_s = random.uniform(onset.low, onset.high) * spec.duration_s;
    spec.faults = draw_faults(twin, label, run.onset_s, random);
    run.end_s = spec.faults.front().end_s;
    run.size = spec.faults.front().size;
  }
  run.log = simulate(robot, spec, seed + static_cast<std::uint64_t>(attempt) * kAttemptSeeds).log;
  if (!twin.has_velocity) run.log.dq.clear();
  return run;
}

}  // namespace

DayDifferences DayDifferences::none(int joints) {
  const std::vector<double> zero(static_cast<std::size_t>(joints), 0.0);
  return {zero, zero, zero, zero, zero, std::vector<double>(zero.size(), 1.0)};
}

double twin_run_length_s(const Twin& twin) {
  return std::max({twin.options.least_length_s, twin.options.least_length_moves * usual_move_s(twin),
                   twin.options.least_length_samples * twin.sample_period_s});
}

std::vector<SimulatedFault> draw_faults(const Twin& twin, const FaultLabel& label, double onset_s,
                                        Random& random) {
  std::vector<SimulatedFault> faults = {draw_fault(twin, label, onset_s, random)};
  if (describe(label.kind).passes) return push_another_joint(twin, std::move(faults), random);
  return faults;
}

TwinRun twin_run(const Twin& twin, const FaultLabel& label, std::uint64_t seed) {
  TwinRun run;
  for (int attempt = 0; attempt < twin.options.attempts; ++attempt) {
    run = try_twin_run(twin, label, seed, attempt);
    const double samples = label.kind == FaultKind::none ? -kSpareAtTheEnd : kNeededAfterOnset;
    const double needed_s = run.onset_s + samples * twin.sample_period_s;
    if (run.log.rows() > 0 && run.log.time.back() >= needed_s) break;
  }
  return run;
}

}  // namespace faultline
