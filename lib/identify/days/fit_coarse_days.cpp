// SPDX-License-Identifier: MIT
#include "lib/identify/days/fit_coarse_days.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lib/balance/balance_model.hpp"
#include "lib/balance/one_step/innovations.hpp"
#include "lib/balance/regress.hpp"
#include "lib/balance/regressor.hpp"
#include "lib/balance/rows.hpp"
#include "lib/core/elementary/elementary.hpp"
#include "lib/core/statistics.hpp"
#include "lib/identify/days/day_arrow.hpp"
#include "lib/identify/days/draft_rows.hpp"
#include "lib/identify/parameter_space.hpp"
#include "lib/identify/physical.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kUnfelt = 1e-9;         // of the squared torques of a link: less is rounding
constexpr double kFrictionWidth = 0.01;  // rad/s or m/s: steep against the speeds of a sample
constexpr double kFirstDoubt = 0.3;      // process noise over torque rms, halved each round: for a poor start
constexpr int kDoubtRounds = 7;          // with that process noise: the last one has 0.5 % of the torque rms
constexpr int kCoarseRounds = 12;        // each a Gauss-Newton step, new smoothed trajectories and new noise
constexpr int kNoiseFrom = 2;            // round from which measurement noise and day variance are learned
constexpr double kLeastReading = 1e-5;   // rad, m, rad/s or m/s: rounding of the values in a log
constexpr double kFree = 100.0;          // SI units: prior standard deviation of a parameter's step
constexpr double kKeptInertia = 0.3;     // of the previous inertia: least share that one step may keep
constexpr int kStepHalvings = 8;         // of a step that keeps less
constexpr int kInertiaRows = 40;         // of each log, at which the inertia is checked
constexpr double kDayInertia = 1e-3;     // relative: least difference of masses between days
constexpr double kDayFriction = 0.02;    // relative
constexpr double kDayViscous = 0.02;     // relative, beyond dry friction
constexpr double kDayForce = 1e-3;       // of the torque rms
constexpr double kDayGain = 1e-3;        // relative
constexpr double kNoGain = 1e-5;         // of a joint along gravity: its gain looks like its mass
constexpr double kCoarseUnseen = 2.0;    // times the variance between the logged days
constexpr double kSpeedQuantile = 0.995;  // of a joint's speed: 1 row in 200 exceeds the top speed

constexpr int kStartRows = 300;       // of each log, whose predictions select the start
constexpr double kStartRidge = 1e-6;  // of each parameter's own square sum

/// Returns the columns that links contribute to: rotor inertia is not identifiable at coarse rates.
std::vector<int> link_columns(const RigidColumns& rigid) {
  std::vector<int> out;
  for (int p = 0; p < rigid.base(); ++p)
    if (!is_rotor(rigid, p)) out.push_back(p);
  return out;
}

/// Returns the model with top speeds and what with_motion_of() takes from the healthy logs.
OneStepModel with_coarse_motion(const std::vector<UniformLog>& logs, OneStepModel m) {
  m = with_motion_of(logs, std::move(m));
  for (const UniformLog& log : logs) {
    const Trajectory x = readings(log);
    for (int j = 0; j < m.torque_rms.size(); ++j) {
      std::vector<double> speed;
      for (int k = 0; k < log.rows(); ++k) speed.push_back(std::abs(x(m.torque_rms.size() + j, k)));
      m.top_speed[j] = std::max(m.top_speed[j], lower_quantile(std::move(speed), kSpeedQuantile));
    }
  }
  m.torque_rms = m.torque_rms.cwiseMax(1e-9);
  return m;
}

/// Returns the variance of the measurements before any robot is fitted, from their fourth differences.
VectorXd first_reading_variance(const std::vector<UniformLog>& logs) {
  const int n = logs.front().joints();
  VectorXd out(2 * n);
  for (int i = 0; i < 2 * n; ++i) {
    std::vector<double> std;
    for (const UniformLog& log : logs) std.push_back(sample_noise(readings(log).row(i).transpose())[0]);
    out[i] = Eigen::numext::abs2(std::max(upper_median(std::move(std)), kLeastReading));
  }
  return out;
}

/// Momentum, and the force other than motor torque and friction, by base parameter: joints x base each.
struct Balance {
  MatrixXd momentum, force;
};

Balance balance_at(const RigidColumns& rigid, const JointVector& q, const JointVector& dq) {
  const int n = rigid.joints();
  const LinkFrames frames = link_frames(rigid.chain, q);
  const auto lift = rigid.lift.topRows(n * kLinkParameters);
  LinkRegressor links;
  Balance out;
  momentum_regressor(frames, dq, links);
  out.momentum = links * lift + dq.asDiagonal() * rigid.lift.bottomRows(n);
  force_regressor(frames, dq, links);
  out.force = links * lift;
  return out;
}

/// Least squares of momentum differences between neighbouring samples, biased by the coarse rate and by
/// noise, which makes the robot too light. Each joint is divided by its torque rms.
VectorXd by_momentum(const std::vector<UniformLog>& logs, const OneStepModel& model) {
  const MotionLayout at = model.layout();
  const RigidColumns& rigid = model.body.rigid();
  const int n = at.joints;
  MatrixXd square = MatrixXd::Zero(at.learned(), at.learned());
  VectorXd vector = VectorXd::Zero(at.learned());
  for (const UniformLog& log : logs) {
    const Trajectory x = readings(log);
    Balance before = balance_at(rigid, x.col(0).head(n), x.col(0).tail(n));
    for (int k = 0; k + 1 < log.rows(); ++k) {
      Balance after = balance_at(rigid, x.col(k + 1).head(n), x.col(k + 1).tail(n));
      if (!log.lost[k] && !log.lost[k + 1]) {
        MatrixXd row = MatrixXd::Zero(n, at.learned());
        row.leftCols(at.base) =
            (after.momentum - before.momentum) / log.period_s - 0.5 * (after.force + before.force);
        const VectorXd speed = 0.5 * (x.col(k) + x.col(k + 1)).tail(n);
        VectorXd torque = log.tau.row(k).transpose();
        if (!model.setting.torque_is_held) torque = 0.5 * (torque + log.tau.row(k + 1).transpose());
        for (int j = 0; j < n; ++j) {
          row(j, at.viscous(j)) = speed[j];
          row(j, at.coulomb(j)) = elementary::tanh(speed[j] / model.body.friction_width()[j]);
          row.row(j) /= model.torque_rms[j];
          torque[j] /= model.torque_rms[j];
        }
        square.noalias() += row.transpose() * row;
        vector.noalias() += row.transpose() * torque;
      }
      before = std::move(after);
    }
  }
  square.diagonal() *= 1.0 + kStartRidge;
  square.diagonal().array() += 1e-12;
  VectorXd theta = square.ldlt().solve(vector);
  theta.tail(2 * n) = theta.tail(2 * n).cwiseMax(0.0);
  return theta;
}

/// Returns the error of one-step predictions with these parameters: the mean of log(1 + square / 2), square
/// in variances of the measurements, so that a few wild predictions do not decide; infinite if the robot
/// cannot be integrated.
double prediction_miss(const std::vector<UniformLog>& logs, OneStepModel model, const VectorXd& numbers) {
  model.theta = numbers;
  const MotionLaw law(model.body, model.numbers());
  double sum = 0.0;
  int count = 0;
  for (const UniformLog& log : logs) {
    const Trajectory read = readings(log);
    const int step = std::max(1, log.rows() / kStartRows);
    for (int k = 0; k + 1 < log.rows(); k += step) {
      if (log.lost[k] || log.lost[k + 1]) continue;
      const VectorXd off = next_state(log, k, read, model.setting, {.usual = &law}) - read.col(k + 1);
      const VectorXd square = off.cwiseAbs2().cwiseQuotient(model.reading_variance);
      if (!square.allFinite()) return std::numeric_limits<double>::infinity();
      for (const double each : square) sum += elementary::log1p(0.5 * each);
      ++count;
    }
  }
  return sum / std::max(count, 1);
}

/// Returns the parameters (MotionLayout::learned()) to start from: those of momentum differences between
/// neighbouring samples or the identified ones, whichever predict the measurements of these logs better.
VectorXd coarse_start(const std::vector<UniformLog>& logs, const OneStepModel& model,
                      const VectorXd& identified_base, const std::vector<Friction>& identified_friction) {
  const MotionLayout at = model.layout();
  VectorXd identified(at.learned());
  identified.head(at.base) = identified_base;
  for (int j = 0; j < at.joints; ++j) {
    identified[at.viscous(j)] = std::max(identified_friction[j].viscous, 0.0);
    identified[at.coulomb(j)] = std::max(identified_friction[j].coulomb, 0.0);
  }
  VectorXd momentum = by_momentum(logs, model);
  return prediction_miss(logs, model, identified) < prediction_miss(logs, model, momentum) ? identified
                                                                                           : momentum;
}

/// Whether the inertia matrix keeps at least `kKeptInertia` of its previous value in any direction, at all
/// positions of the logs.
bool keeps_inertia(const std::vector<UniformLog>& logs, const OneStepModel& m, const VectorXd& theta) {
  const int base = m.layout().base;
  const RigidColumns& rigid = m.body.rigid();
  const Chain before = chain_of(rigid, m.theta.head(base)), after = chain_of(rigid, theta.head(base));
  for (const UniformLog& log : logs) {
    const int step = std::max(1, log.rows() / kInertiaRows);
    for (int k = 0; k < log.rows(); k += step) {
      const JointVector q = log.q.row(k).transpose();
      const JointMatrix rest = inertia_matrix(after, q) - kKeptInertia * inertia_matrix(before, q);
      if (rest.llt().info() != Eigen::Success) return false;
    }
  }
  return true;
}

/// Returns the parameters after a step, shortened until the inertia matrix stays positive definite.
VectorXd stepped(const std::vector<UniformLog>& logs, const OneStepModel& m, const VectorXd& step) {
  const int friction = 2 * m.joints();
  double share = 1.0;
  for (int k = 0; k <= kStepHalvings; ++k, share *= 0.5) {
    VectorXd theta = m.theta + share * step;
    theta.tail(friction) = theta.tail(friction).cwiseMax(0.0);
    if (keeps_inertia(logs, m, theta)) return theta;
  }
  return m.theta;
}

/// A healthy log, the trajectory about which it is linearised, and the effects of its day.
struct CoarseDay {
  UniformLog log;
  Trajectory about;
  VectorXd effect;
};

/// Returns the derivative of the numbers of a day by the parameters of the robot: numbers x parameters.
MatrixXd robot_directions(const OneStepModel& m, const VectorXd& effect) {
  const MotionLayout at = m.layout();
  const StepDayLayout day = m.day_layout();
  MatrixXd out = MatrixXd::Identity(at.count(), at.learned());
  for (int p = 0; p < at.base; ++p) out(p, p) += effect[day.inertia(p)];
  for (int j = 0; j < at.joints; ++j) {
    const double part = viscous_part(m.theta[at.viscous(j)], m.theta[at.coulomb(j)], m.top_speed[j]);
    const double common = effect[day.friction(j)], excess = effect[day.viscous_excess(j)];
    out(at.viscous(j), at.viscous(j)) += common + (1.0 - part) * excess;
    out(at.coulomb(j), at.coulomb(j)) += common - part * excess;
  }
  return out;
}

/// One log, integrated: step of the robot's parameters and effects of the day in one regression.
struct CoarsePass {
  NormalEquations sums;  ///< normal equations of the step, then of the effects
  Trajectory about;      ///< trajectory smoothed anew
  VectorXd square;       ///< by measurement: sum of squared residual and variance of that trajectory
};

CoarsePass passed(const CoarseDay& day, const OneStepModel& m, double doubt) {
  const MotionLayout at = m.layout();
  const MatrixXd effects = m.day_directions();
  const MotionLaw law(m.body, m.numbers() + effects * day.effect);
  const LinearSteps steps = linear_steps(day.log, day.about, m.setting, {.usual = &law});
  MatrixXd directions(at.count(), at.learned() + effects.cols());
  directions << robot_directions(m, day.effect), effects;
  FilterInput in;
  in.column = steps.columns(directions, MatrixXd(at.count(), 0));
  const MatrixXd wide = (doubt * m.torque_rms).replicate(1, steps.intervals);
  in.process = process_covariance(
      steps, at, (m.force_std(day.log, day.about).cwiseAbs2() + wide.cwiseAbs2()).cwiseSqrt());
  const Trajectory read = readings(day.log);
  in.reading = read - day.about;
  in.variance = m.variance_of_readings(day.log);
  const Innovations filter = innovations(steps, in);
  const auto white = filter.white.rightCols(directions.cols());
  const VectorXd rows = filter.white.col(0) + white.rightCols(effects.cols()) * day.effect;
  CoarsePass out{normal_equations(white, rows), {}, {}};
  MatrixXd variance;
  out.about = day.about + smoothed(steps, filter, VectorXd::Zero(directions.cols()), &variance);
  out.square = ((read - out.about).cwiseAbs2() + variance.cwiseMax(0.0)).rowwise().sum();
  return out;
}

/// Returns the least variance of the effects of a day.
VectorXd least_day_variance(const OneStepModel& m) {
  const StepDayLayout day = m.day_layout();
  VectorXd std = VectorXd::Constant(day.count(), kDayInertia);
  for (int j = 0; j < m.joints(); ++j) {
    std[day.friction(j)] = kDayFriction;
    std[day.viscous_excess(j)] = kDayViscous;
    std[day.force(j)] = kDayForce * m.torque_rms[j];
    std[day.gain(j)] = carries_weight(m.body.rigid(), j) ? kNoGain : kDayGain;
  }
  return std.cwiseAbs2();
}

/// Returns, by link, the mass in kg at its end that best explains the torque of its joint, or of the last
/// joint before it that feels that mass.
VectorXd carried_masses(const std::vector<UniformLog>& logs, const OneStepModel& m) {
  const int n = m.joints(), base = m.layout().base;
  MatrixXd num = MatrixXd::Zero(n, n), den = MatrixXd::Zero(n, n);  // links x joints
  MatrixXd torque(n, base);
  for (const UniformLog& log : logs) {
    const Trajectory x = readings(log);
    for (int k = 0; k + 1 < log.rows(); ++k) {
      const JointVector ddq = (x.col(k + 1) - x.col(k)).tail(n) / log.period_s;
      m.body.torque_by_parameter(x.col(k).head(n), x.col(k).tail(n), ddq, torque);
      const MatrixXd unit = m.payload.transpose() * torque.transpose();
      num += unit * (torque * m.theta.head(base)).asDiagonal();
      den += unit.cwiseAbs2();
    }
  }
  VectorXd out = VectorXd::Ones(n);
  for (int link = 0; link < n; ++link)
    for (int j = 0; j <= link; ++j)
      if (den(link, j) > kUnfelt * den.row(link).maxCoeff())
        out[link] = std::abs(num(link, j) / den(link, j));
  return out;
}

/// Returns the space with the lengths, of a payload's place, that base parameters and known facts determine.
ParameterSpace with_settled_lengths(const Robot& robot, ParameterSpace space, const std::vector<int>& kept,
                                    const OneStepModel& m, const MatrixXd& covariance) {
  BaseEstimate base;
  const int count = space.count();
  base.estimate = VectorXd::Zero(count);
  base.covariance = 1e-12 * MatrixXd::Identity(count, count);
  base.usable.assign(space.rigid(), false);
  for (std::size_t a = 0; a < kept.size(); ++a) {
    base.estimate[kept[a]] = m.theta[static_cast<Eigen::Index>(a)];
    base.usable[kept[a]] = true;
    for (std::size_t b = 0; b < kept.size(); ++b)
      base.covariance(kept[a], kept[b]) =
          covariance(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
  }
  const PhysicalFit physical = physical_parameters(robot, space, std::span(&base, 1));
  for (std::size_t i = 0; i < space.chain.length.size() && i < physical.lengths.size(); ++i)
    if (std::isfinite(physical.lengths[i]) && physical.lengths[i] > 0.0)
      space.chain.length[i] = physical.lengths[i];
  return space;
}

}  // namespace

OneStepModel fit_coarse_days(std::span<LogSource* const> sources, const Robot& robot,
                             const ParameterSpace& space, TorqueTiming torque_between_samples) {
  const std::vector<UniformLog> logs = uniform_logs(sources);
  OneStepModel m;
  RigidColumns rigid{space.chain, space.lift};
  const std::vector<int> kept = link_columns(rigid);
  rigid.lift = space.lift(Eigen::all, kept).eval();
  m.body = MotionBody(std::move(rigid), VectorXd::Constant(space.joints(), kFrictionWidth));
  m.setting.period_s = logs.front().period_s;
  m.setting.torque_is_held = torque_between_samples == TorqueTiming::held;
  m = with_coarse_motion(logs, std::move(m));
  m.reading_variance = first_reading_variance(logs);
  m.theta = coarse_start(logs, m, parameters_of(space, robot.chain, 0.0)(kept), robot.chain.friction);
  const MotionLayout at = m.layout();
  const VectorXd least = least_day_variance(m);
  VectorXd between = least;
  std::vector<CoarseDay> days;
  double samples = 0.0;
  for (const UniformLog& log : logs) {
    days.push_back({log, readings(log), VectorXd::Zero(least.size())});
    samples += log.rows();
  }
  MatrixXd covariance;
  for (int it = 0; it < kCoarseRounds; ++it) {
    const double doubt = it < kDoubtRounds ? kFirstDoubt * std::ldexp(1.0, -it) : 0.0;
    std::vector<DayBlock> blocks;
    VectorXd square = VectorXd::Zero(2 * at.joints);
    for (CoarseDay& day : days) {
      CoarsePass pass = passed(day, m, doubt);
      blocks.push_back(day_block(pass.sums, between));
      day.about = std::move(pass.about);
      square += pass.square;
    }
    const Regression fit =
        regress(robot_sums(blocks), VectorXd::Constant(at.learned(), 1.0 / (kFree * kFree)));
    covariance = fit.covariance();
    for (std::size_t d = 0; d < days.size(); ++d) days[d].effect = blocks[d].effect(fit.estimate);
    m.theta = stepped(logs, m, fit.estimate);
    if (it < kNoiseFrom) continue;
    between = effect_moments(blocks, fit.estimate).square.cwiseMax(least);
    m.reading_variance = (square / samples).cwiseMax(kLeastReading * kLeastReading);
  }
  m.payload = payload_columns(with_settled_lengths(robot, space, kept, m, covariance))(kept, Eigen::all);
  m.carried_kg = carried_masses(logs, m);
  m.day_variance = least + kCoarseUnseen * (between - least);
  for (int p = 0; p < at.base; ++p)
    m.day_variance[p] += 9.0 * covariance(p, p) / std::max(Eigen::numext::abs2(m.theta[p]), 1e-12);
  return m;
}

}  // namespace faultline
