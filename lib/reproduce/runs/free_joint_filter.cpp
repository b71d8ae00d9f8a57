// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/free_joint_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "lib/balance/one_step/innovations.hpp"
#include "lib/core/elementary/elementary.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array kMissedShares = {0.0, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0};
constexpr int kMatchedRows = 2000;         // of all healthy logs: enough for one number
constexpr double kUniformVariance = 12.0;  // the square of a uniform range over its variance

/// The state q, dq of one filter.
struct Estimate {
  VectorXd mean;
  MatrixXd covariance;
};

/// Takes in a sample, reading by reading; returns its log likelihood.
double take_in(const VectorXd& reading, const VectorXd& variance, Estimate& state) {
  double out = 0.0;
  for (Eigen::Index i = 0; i < reading.size(); ++i) {
    if (variance[i] > kNoReading) continue;
    const double s = state.covariance(i, i) + variance[i], off = reading[i] - state.mean[i];
    const VectorXd gain = state.covariance.col(i) / s;
    state.mean += off * gain;
    state.covariance -= s * gain * gain.transpose();
    out -= 0.5 * (off * off / s + elementary::log(2.0 * std::numbers::pi * s));
  }
  return out;
}

/// One log, sample by sample.
class FilteredLog {
 public:
  FilteredLog(const FilteredRobot& robot, const Log& log)
      : robot_(robot), log_(read(robot, log)), readings_(faultline::readings(log_)) {
    variances_ = robot.steps.variance_of_readings(log_);
  }

  int samples() const { return log_.rows(); }
  double time_s(int k) const { return log_.time_s(k); }

  /// The state that the first sample shows.
  Estimate first() const { return {readings_.col(0), MatrixXd(variances_.col(0).asDiagonal())}; }

  /// Moves a state from sample k to the next one, before that one is taken in.
  Estimate predicted(const Estimate& state, int k, const MotionLaw& law) const {
    const OneStepModel& m = robot_.steps;
    UniformLog interval;
    interval.start_s = log_.time_s(k);
    interval.period_s = log_.period_s;
    interval.q = log_.q.middleRows(k, 2);
    if (log_.dq.rows() > 0) interval.dq = log_.dq.middleRows(k, 2);
    interval.tau = log_.tau.middleRows(k, 2);
    interval.lost = {log_.lost[k], log_.lost[k + 1]};
    Trajectory about(state.mean.size(), 2);
    about << state.mean, readings_.col(k + 1);
    const LinearSteps steps = linear_steps(interval, about, m.setting, {.usual = &law});
    const VectorXd next = about.col(1) + steps.miss.col(0);
    about.col(1) = next;
    const VectorXd missed = robot_.missed_share * m.torque_rms;
    const MatrixXd force = (m.force_std(interval, about).col(0).cwiseAbs2() + missed.cwiseAbs2()).cwiseSqrt();
    const MatrixXd a = steps.slope_of(0), spread = a * state.covariance * a.transpose();
    return {next, 0.5 * (spread + spread.transpose()) + process_covariance(steps, m.layout(), force)};
  }

  double take_in(int k, Estimate& state) const {
    return faultline::take_in(readings_.col(k), variances_.col(k), state);
  }

 private:
  static UniformLog read(const FilteredRobot& robot, const Log& log) {
    MemorySource source(log, "run");
    return uniform_log(source, robot.steps.setting.period_s);
  }

  const FilteredRobot& robot_;
  UniformLog log_;
  Trajectory readings_;
  MatrixXd variances_;
};

double log_likelihood(const FilteredRobot& robot, const Log& log) {
  const FilteredLog samples(robot, log);
  const MotionLaw healthy(robot.steps.body, robot.steps.numbers());
  Estimate state = samples.first();
  double out = 0.0;
  for (int k = 0; k + 1 < samples.samples(); ++k) {
    state = samples.predicted(state, k, healthy);
    out += samples.take_in(k + 1, state);
  }
  return out;
}

/// The laws of free-swinging joints 1, 2, ...
std::vector<MotionLaw> free_joints(const OneStepModel& robot) {
  std::vector<MotionLaw> out;
  for (int j = 0; j < robot.joints(); ++j) {
    VectorXd numbers = robot.numbers();
    numbers[robot.layout().gain(j)] = 0.0;
    out.emplace_back(robot.body, numbers);
  }
  return out;
}

/// The fault began somewhere within the step that leads from one healthy state to `healthy` without it and to
/// `faulty` with it all the while.
Estimate begun_within(const Estimate& healthy, Estimate faulty) {
  const VectorXd difference = faulty.mean - healthy.mean;
  faulty.mean -= 0.5 * difference;
  faulty.covariance += difference * difference.transpose() / kUniformVariance;
  return faulty;
}

/// The alarms of one threshold.
class Threshold {
 public:
  Threshold(double nats, double name_s) : nats_(nats), name_s_(name_s) {}

  void take(double time_s, double sum, int largest) {
    if (!open_ && sum >= nats_) {
      open_ = true;
      alarms.push_back({time_s, {}});
    }
    if (sum <= 0.0) open_ = false;
    if (alarms.empty() || time_s > alarms.back().time_s + name_s_) return;
    if (sum > 0.0) alarms.back().label = {FaultKind::free_swinging, Joint::at(largest)};
  }

  Alarms alarms;

 private:
  double nats_, name_s_;
  bool open_ = false;
};

/// Of each free joint: its filter and its sum, nats.
struct Running {
  Estimate state;
  double sum = 0.0;
};

}  // namespace

FilteredRobot with_missed_share(const OneStepModel& robot, const std::vector<Log>& healthy) {
  const int each = kMatchedRows / static_cast<int>(healthy.size());
  FilteredRobot best{robot, 0.0};
  double most = -std::numeric_limits<double>::infinity();
  for (const double share : kMissedShares) {
    const FilteredRobot trial{robot, share};
    double sum = 0.0;
    for (const Log& log : healthy) sum += log_likelihood(trial, slice(log, 0, std::min(log.rows(), each)));
    if (!(sum > most)) continue;
    most = sum;
    best.missed_share = share;
  }
  return best;
}

std::vector<Alarms> free_joint_alarms(const FilteredRobot& robot, const Log& log,
                                      const std::vector<double>& thresholds, double name_s) {
  const FilteredLog samples(robot, log);
  const MotionLaw usual(robot.steps.body, robot.steps.numbers());
  const std::vector<MotionLaw> free = free_joints(robot.steps);
  std::vector<Running> running(free.size());
  std::vector<Threshold> watched;
  for (const double nats : thresholds) watched.emplace_back(nats, name_s);
  Estimate healthy = samples.first();
  for (int k = 0; k + 1 < samples.samples(); ++k) {
    const Estimate before = std::exchange(healthy, samples.predicted(healthy, k, usual));
    const Estimate unseen = healthy;
    const double by_healthy = samples.take_in(k + 1, healthy);
    for (std::size_t j = 0; j < free.size(); ++j) {
      Running& fault = running[j];
      const bool goes_on = fault.sum > 0.0;
      fault.state = samples.predicted(goes_on ? fault.state : before, k, free[j]);
      if (!goes_on) fault.state = begun_within(unseen, std::move(fault.state));
      fault.sum = std::max(fault.sum + samples.take_in(k + 1, fault.state) - by_healthy, 0.0);
    }
    const auto largest = std::max_element(running.begin(), running.end(),
                                          [](const Running& a, const Running& b) { return a.sum < b.sum; });
    for (Threshold& threshold : watched)
      threshold.take(samples.time_s(k + 1), largest->sum, static_cast<int>(largest - running.begin()));
  }
  std::vector<Alarms> alarms;
  for (Threshold& threshold : watched) alarms.push_back(std::move(threshold.alarms));
  return alarms;
}

}  // namespace faultline
