// SPDX-License-Identifier: MIT
#include "lib/identify/excitation/suggest_motion.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lib/core/matrix/decompositions.hpp"
#include "lib/core/parallel.hpp"
#include "lib/core/random.hpp"
#include "lib/identify/excitation/excitation.hpp"
#include "lib/identify/parameter_space.hpp"
#include "lib/identify/weak_form/weak_form.hpp"
#include "lib/robot/dynamics.hpp"
#include "lib/robot/toml/toml_values.hpp"
#include "lib/simulate/motion.hpp"

namespace faultline {
namespace {

/// Range and speed allowed to a joint that the logs hardly moved, by kind of joint.
struct Modest {
  double range, speed, least_range, least_speed;
};
// rad and rad/s, m and m/s: below a least value, the logs hardly move the joint.
constexpr Modest kTurning = {1.0, 1.0, 0.3, 0.2}, kSliding = {0.1, 0.1, 0.03, 0.02};

constexpr std::array<double, 4> kPeriods_s = {5.0, 8.0, 12.0, 20.0};  // each candidate draws one
constexpr int kFewestHarmonics = 3, kMoreHarmonics = 5;               // each candidate draws 3 to 7
constexpr double kLeast_s = 20.0;             // least duration of the motion, which has whole periods
constexpr double kSlowestSample_s = 0.005;    // logs this slow or slower get a suggestion with this period
constexpr double kLook_s = 0.01;              // steps at which speed and torque are evaluated
constexpr std::uint64_t kFirstSeed = 100000;  // of the candidates

constexpr double kStep_s = 0.02;       // between samples of a motion, whose fastest harmonic lasts 0.7 s
constexpr double kWindow_s = 0.16;     // as long as the windows that judge the terms of logs (kYardstick_s)
constexpr int kManyWindows = 1 << 20;  // so many that none is dropped
constexpr double kRank = 1e-13;        // of the largest eigenvalue: smaller ones are zero

struct Candidate {
  std::uint64_t seed = 0;
  SimulationSpec simulation;
  Eigen::MatrixXd moments;
};

std::vector<SuggestedJoint> allowed_joints(const Identification& id) {
  std::vector<SuggestedJoint> joints;
  for (int j = 0; j < id.space.joints(); ++j) {
    const bool turns = id.space.chain.geometry[j].kind == AxisKind::revolute;
    const Modest& modest = turns ? kTurning : kSliding;
    const JointExcitation& seen = id.excitation.joints[j];
    SuggestedJoint joint{id.space.chain.geometry[j].kind, seen.q_low, seen.q_high,
                         std::max(seen.fastest_forward, seen.fastest_back)};
    if (joint.high - joint.low < modest.least_range) {
      const double middle = 0.5 * (joint.low + joint.high);
      joint.low = middle - 0.5 * modest.range;
      joint.high = middle + 0.5 * modest.range;
      joint.beyond_logs = true;
    }
    if (joint.fastest < modest.least_speed) {
      joint.fastest = modest.speed;
      joint.beyond_logs = true;
    }
    joints.push_back(joint);
  }
  return joints;
}

/// Returns the largest speed of each joint over a period.
Eigen::VectorXd fastest_of(const Motion& motion, int joints, double period_s) {
  Eigen::VectorXd fastest = Eigen::VectorXd::Zero(joints);
  Reference at;
  for (double t = 0.0; t < period_s; t += kLook_s) {
    motion.at(t, at);
    fastest = fastest.cwiseMax(at.dq.cwiseAbs());
  }
  return fastest;
}

void set_ranges(const std::vector<SuggestedJoint>& joints, const Eigen::VectorXd& share, MotionSpec& motion) {
  motion.low.clear();
  motion.high.clear();
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const double middle = 0.5 * (joints[j].low + joints[j].high);
    const double half = 0.5 * (joints[j].high - joints[j].low) * share[static_cast<Eigen::Index>(j)];
    motion.low.push_back(middle - half);
    motion.high.push_back(middle + half);
  }
}

Stretch stretch_of(const Motion& reference, int joints, double duration_s) {
  const int rows = static_cast<int>(std::lround(duration_s / kStep_s)) + 1;
  Stretch s;
  s.period_s = kStep_s;
  s.time.resize(rows);
  s.q_smooth.resize(joints, rows);
  s.dq_smooth.resize(joints, rows);
  s.tau.setZero(joints, rows);
  s.outlier.setZero(2 * joints, rows);
  Reference at;
  for (int k = 0; k < rows; ++k) {
    s.time[k] = k * kStep_s;
    reference.at(s.time[k], at);
    s.q_smooth.col(k) = at.q;
    s.dq_smooth.col(k) = at.dq;
  }
  s.q = s.q_smooth;
  s.dq = s.dq_smooth;
  return s;
}

/// Returns `Excitation::moments` of a log of `duration_s` along that reference, in the columns and scales of
/// `of`.
Eigen::MatrixXd motion_moments(const ParameterSpace& space, const Excitation& of, const Motion& reference,
                               double duration_s) {
  const Stretch stretch = stretch_of(reference, space.joints(), duration_s);
  WeakWindows windows(kWindow_s, kManyWindows);
  windows.add(stretch, stretch_terms(space, stretch), ShiftRange{0, 0});
  const auto count = static_cast<Eigen::Index>(of.columns.size());
  Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(count, count);
  for (const WeakWindow& w : windows.all())
    for (int j = 0; j < space.joints(); ++j) {
      const Eigen::RowVectorXd row =
          linear_row(space, w, j, kOwnWidth, kOwnWidth)(of.columns) / of.joint_scale[j];
      moments += row.transpose() * row;
    }
  return moments / static_cast<double>(std::max<std::size_t>(windows.all().size(), 1));
}

/// Returns the condition number of a motion's regressor, each column divided by its `unit`, so that a weakly
/// excited column counts as much as one that is hardly separable from the others; infinite if one is not
/// identifiable.
double condition_of(const Eigen::MatrixXd& moments, const Eigen::VectorXd& unit) {
  const Eigen::VectorXd scale = unit.cwiseMax(std::numeric_limits<double>::min()).cwiseInverse();
  const Eigen::VectorXd values = symmetric_eigenvalues(scale.asDiagonal() * moments * scale.asDiagonal());
  const double least = values.minCoeff(), most = values.maxCoeff();
  return least > kRank * most ? std::sqrt(most / least) : std::numeric_limits<double>::infinity();
}

/// Draws random harmonics over the allowed ranges and shrinks those of a joint that would be too fast.
Candidate draw_candidate(const Identification& id, const std::vector<SuggestedJoint>& joints,
                         const SimulationSpec& common, std::uint64_t seed) {
  Random random(seed);
  Candidate out{seed, common, {}};
  MotionSpec& motion = out.simulation.motion;
  motion.profile = MotionProfile::fourier;
  motion.fourier_period_s = kPeriods_s[random.bits() % kPeriods_s.size()];
  motion.harmonics = kFewestHarmonics + static_cast<int>(random.bits() % kMoreHarmonics);
  const double period_s = motion.fourier_period_s;
  out.simulation.duration_s = period_s * std::ceil(kLeast_s / period_s);
  Eigen::VectorXd share = Eigen::VectorXd::Ones(id.space.joints());
  set_ranges(joints, share, motion);
  const Eigen::VectorXd fastest =
      fastest_of(reference_motion(id.robot, out.simulation, seed), id.space.joints(), period_s);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    share[i] = std::min(1.0, joints[j].fastest / std::max(fastest[i], 1e-12));
  }
  set_ranges(joints, share, motion);
  out.moments =
      motion_moments(id.space, id.excitation, reference_motion(id.robot, out.simulation, seed), period_s);
  return out;
}

/// Returns sampling and noise as in the logs.
SimulationSpec common_of(const Identification& id) {
  SimulationSpec spec;
  double period_s = kSlowestSample_s;
  for (const IdentifiedLog& log : id.logs)
    if (log.sample_period_s > 0.0) period_s = std::min(period_s, log.sample_period_s);
  spec.sample_period_s = spec.control_period_s = period_s;
  spec.max_step_s = std::min(spec.max_step_s, period_s);
  spec.noise.q = id.q_noise;
  spec.noise.dq = id.dq_noise;
  return spec;
}

void tell_joints(const Identification& id, const Candidate& best, SuggestedMotion& out) {
  const Motion motion = reference_motion(id.robot, best.simulation, best.seed);
  const double period_s = best.simulation.motion.fourier_period_s;
  const Eigen::VectorXd fastest = fastest_of(motion, id.space.joints(), period_s);
  Eigen::VectorXd torque = Eigen::VectorXd::Zero(id.space.joints());
  Reference at;
  for (double t = 0.0; t < period_s; t += kLook_s) {
    motion.at(t, at);
    torque = torque.cwiseMax(inverse_dynamics(id.robot.chain, at.q, at.dq, at.ddq).cwiseAbs());
  }
  for (std::size_t j = 0; j < out.joints.size(); ++j) {
    SuggestedJoint& joint = out.joints[j];
    joint.low = best.simulation.motion.low[j];
    joint.high = best.simulation.motion.high[j];
    joint.fastest = fastest[static_cast<Eigen::Index>(j)];
    joint.torque = torque[static_cast<Eigen::Index>(j)];
  }
}

std::string list(const std::vector<double>& values) {
  return toml_numbers(
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
}

std::string comments(const SuggestedMotion& motion) {
  std::string text = fmt::format(
      "# A motion that determines the parameters: condition number {:.3g}, that of the logs was {:.3g}.\n"
      "# Check before a robot runs it: the work space must be free and the drives strong enough.\n",
      motion.condition, motion.condition_of_logs);
  for (int j = 0; j < std::ssize(motion.joints); ++j)
    text += fmt::format(
        "#   joint {}: at most {:.3g} {}, {:.3g} {}{}\n", Joint::at(j), motion.joints[j].fastest,
        velocity_unit(motion.joints[j].kind), motion.joints[j].torque, torque_unit(motion.joints[j].kind),
        motion.joints[j].beyond_logs ? "; farther or faster than in the logs, which hardly move this joint"
                                     : "");
  return text;
}

}  // namespace

SuggestedMotion suggest_motion(const Identification& id, const SuggestOptions& options) {
  SuggestedMotion out;
  out.joints = allowed_joints(id);
  const SimulationSpec common = common_of(id);
  std::vector<Candidate> candidates(options.candidates);
  parallel_for(options.candidates, options.threads, [&](int i) {
    candidates[i] = draw_candidate(id, out.joints, common, kFirstSeed + static_cast<std::uint64_t>(i));
  });
  const auto count = static_cast<Eigen::Index>(id.excitation.columns.size());
  Eigen::VectorXd square = Eigen::VectorXd::Zero(count);
  for (const Candidate& c : candidates) square += c.moments.diagonal() / options.candidates;
  const Eigen::VectorXd unit = square.cwiseSqrt();
  std::vector<double> condition;
  for (const Candidate& c : candidates) condition.push_back(condition_of(c.moments, unit));
  const auto best =
      static_cast<std::size_t>(std::min_element(condition.begin(), condition.end()) - condition.begin());
  out.simulation = candidates[best].simulation;
  out.seed = candidates[best].seed;
  out.condition = condition[best];
  out.condition_of_logs = condition_of(id.excitation.moments, unit);
  tell_joints(id, candidates[best], out);
  return out;
}

std::string suggestion_text(const SuggestedMotion& motion, const std::string& robot_file) {
  const SimulationSpec& s = motion.simulation;
  std::string text = comments(motion);
  text += fmt::format(
      "robot = {}\nduration_s = {}\nsample_period_s = {}\ncontrol_period_s = \"held\"\nmax_step_s = {}\n",
      toml_quoted(robot_file), toml_number(s.duration_s), toml_number(s.sample_period_s),
      toml_number(s.max_step_s));
  text += fmt::format(
      "record_reference = true\n\n[motion]\nprofile = \"fourier\"\nlow = {}\nhigh = {}\nharmonics = {}\n"
      "fourier_period_s = {}\n\n[noise]\nq = {}\n",
      list(s.motion.low), list(s.motion.high), s.motion.harmonics, toml_number(s.motion.fourier_period_s),
      list(s.noise.q));
  if (!s.noise.dq.empty()) text += fmt::format("dq = {}\n", list(s.noise.dq));
  return text + fmt::format("\n[[run]]\nname = \"suggested\"\nseed = {}\n", motion.seed);
}

}  // namespace faultline
