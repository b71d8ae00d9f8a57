// SPDX-License-Identifier: MIT
#include "lib/diagnose/stop/stop_channels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <variant>

#include "lib/diagnose/stop/stop_signs.hpp"
#include "lib/residual/relation/relation_detector.hpp"
#include "lib/residual/relation/relation_residual.hpp"
#include "lib/residual/residuals.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
constexpr double kSignBlock_s = 0.1;              // length of a block of samples that is outside or not,
constexpr int kSignBlockSamples = 5;              // at least so many samples
constexpr const char* kTimesHealthy = "healthy";  // unit: times the healthy spread

/// Largest magnitude in the last moment and before it; NaN without a value.
struct TwoPeaks {
  double value = kNoValue, before = kNoValue;

  void add(bool is_last, double magnitude) {
    double& peak = is_last ? value : before;
    if (std::isfinite(magnitude) && !(peak >= magnitude)) peak = magnitude;
  }
};

/// Returns the root mean square of a joint's whitened residuals between two times; NaN without rows.
double spread_between(const BalanceCourse& course, int j, double from_s, double to_s) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < course.time_s.size(); ++k) {
    const double square = course.square(static_cast<Eigen::Index>(k), j);
    if (!(course.time_s[k] > from_s) || course.time_s[k] > to_s || !std::isfinite(square)) continue;
    sum += square;
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : kNoValue;
}

int rows_between_times(const BalanceCourse& course, int j, double from_s, double to_s) {
  int count = 0;
  for (std::size_t k = 0; k < course.time_s.size(); ++k)
    if (course.time_s[k] > from_s && course.time_s[k] <= to_s &&
        std::isfinite(course.square(static_cast<Eigen::Index>(k), j)))
      ++count;
  return count;
}

void mark_deviation(StopChannel& channel, const std::optional<Deviation>& deviation) {
  channel.state = deviation ? SignalState::changed : SignalState::normal;
  if (deviation) channel.since_s = deviation->start_s;
}

/// A signal that was as far outside before the last moment has not changed with it.
void compare_with_before(StopChannel& channel) {
  if (channel.state != SignalState::changed || !(channel.value <= channel.before)) return;
  channel.state = SignalState::as_before;
  channel.since_s = kNoValue;
}

StopChannel balance_channel(const StopRows& rows, const Model& model, int j) {
  StopChannel out{.signal = StopSignal::torque_balance, .joint = Joint::at(j), .unit = kTimesHealthy};
  if (!rows.course) return out;
  const BalanceCourse& course = *rows.course;
  out.value = spread_between(course, j, rows.moment_start_s(), rows.stop_s);
  if (!std::isfinite(out.value)) return out;
  for (double end = rows.moment_start_s(); end - rows.moment_s >= rows.log.time.front(); end -= rows.moment_s)
    out.before = std::fmax(out.before, spread_between(course, j, end - rows.moment_s, end));
  const double limit = balance_limit(model.explain);
  const int count = rows_between_times(course, j, rows.moment_start_s(), rows.stop_s);
  out.limit = std::sqrt(2.0 * (kNatsOfHealthyRow + limit / count));
  mark_deviation(out, lasting_deviation(balance_deviations(course, j, limit), rows.stop_s, rows.moment_s));
  return out;
}

/// A series of magnitudes of one joint's regenerated motion, times healthy, and their healthy range.
struct MotionSeries {
  StopSignal signal;
  Eigen::VectorXd magnitude;
  double largest = 0.0;
};

StopChannel motion_channel(const StopRows& rows, const Model& model, const Residuals& residuals,
                           const MotionSeries& series, Joint joint) {
  StopChannel out{.signal = series.signal, .joint = joint, .limit = series.largest, .unit = kTimesHealthy};
  std::vector<double> time, magnitude;
  TwoPeaks peaks;
  int in_moment = 0;
  for (int i = 0; i < residuals.count(); ++i) {
    if (!std::isfinite(series.magnitude[i])) continue;
    const bool is_last = residuals.time[i] > rows.moment_start_s();
    in_moment += is_last;
    peaks.add(is_last, series.magnitude[i]);
    time.push_back(residuals.time[i]);
    magnitude.push_back(series.magnitude[i]);
  }
  out.value = peaks.value;
  out.before = peaks.before;
  if (in_moment == 0) return out;
  const int block = std::max(kSignBlockSamples, static_cast<int>(std::lround(kSignBlock_s / rows.period_s)));
  const double blocks = std::max(1.0, std::ceil(static_cast<double>(in_moment) / block));
  const double chance = kChanceOfSign / (2.0 * blocks * residuals.joints());
  const int enough = samples_by_chance(block, model.residual.healthy.patterns, chance);
  mark_deviation(out, lasting_deviation(sample_deviations(time, magnitude, series.largest, block, enough),
                                        rows.stop_s, rows.moment_s));
  compare_with_before(out);
  return out;
}

std::vector<StopChannel> motion_channels(const StopRows& rows, const Model& model, const Residuals& residuals,
                                         int j) {
  const Joint joint = Joint::at(j);
  if (residuals.count() == 0)
    return {{.signal = StopSignal::motion_velocity, .joint = joint, .unit = kTimesHealthy},
            {.signal = StopSignal::motion_position, .joint = joint, .unit = kTimesHealthy}};
  const HealthyResiduals& healthy = model.residual.healthy;
  return {motion_channel(rows, model, residuals,
                         {StopSignal::motion_velocity, residuals.velocity.row(j).cwiseAbs().transpose(),
                          healthy.velocity_max[j] / healthy.velocity_rms[j]},
                         joint),
          motion_channel(rows, model, residuals,
                         {StopSignal::motion_position, residuals.position.row(j).cwiseAbs().transpose(),
                          healthy.position_max[j] / healthy.position_rms[j]},
                         joint)};
}

StopSignal signal_of(const SignalRelation& relation) {
  if (relation.kind == RelationKind::actuator) return StopSignal::actuator;
  if (relation.kind == RelationKind::control_law) return StopSignal::control_law;
  return relation.target == Quantity::q ? StopSignal::tracking_position : StopSignal::tracking_velocity;
}

const char* unit_of_channel(Quantity quantity, AxisKind axis) {
  if (is_torque(quantity)) return torque_unit(axis);
  return quantity == Quantity::q ? position_unit(axis) : velocity_unit(axis);
}

/// The channel of a relation: the largest mean over its shortest window, and the episodes of its detector.
StopChannel relation_channel(const StopRows& rows, const Model& model, const SignalRelation& relation) {
  const AxisKind axis = model.robot.chain.geometry[relation.joint.index()].kind;
  StopChannel out{
      .signal = signal_of(relation), .joint = relation.joint, .unit = unit_of_channel(relation.target, axis)};
  if (!has_signals(rows.log, relation) || relation.windows.empty()) return out;
  RelationDetector detector(relation);
  detector.take(rows.log);
  detector.finish();
  if (!(detector.judged_s() > 0.0)) return out;
  RelationResidual residual(relation);
  WindowedMeans means(window_rows(std::array{relation.windows.front().window_s}, relation.period_s));
  TwoPeaks peaks;
  for (int k = 0; k < rows.log.rows(); ++k) {
    const auto sample = residual.take(rows.log, k);
    if (!sample) continue;
    means.add(sample->residual, sample->time);
    if (means.full() > 0) peaks.add(sample->time > rows.moment_start_s(), std::abs(means.mean(0)));
  }
  out.value = peaks.value;
  out.before = peaks.before;
  if (!std::isfinite(out.value)) return out;
  out.limit = allowed_mean(relation, 0);
  std::vector<Deviation> deviations;
  for (const RelationEpisode& episode : detector.episodes())
    deviations.push_back({episode.onset_s, episode.lasts ? rows.stop_s : episode.end_s});
  mark_deviation(out, lasting_deviation(deviations, rows.stop_s, rows.moment_s));
  return out;
}

/// A reference that the model has no healthy range for: compared with the rest of the log.
StopChannel raw_tracking(const StopRows& rows, const Model& model, int j, bool of_position) {
  StopChannel out{
      .signal = of_position ? StopSignal::tracking_position : StopSignal::tracking_velocity,
      .joint = Joint::at(j),
      .unit = unit_of_channel(of_position ? Quantity::q : Quantity::dq, model.robot.chain.geometry[j].kind)};
  const JointSignals& reference = of_position ? rows.log.q_ref : rows.log.dq_ref;
  const JointSignals& motion = of_position ? rows.log.q : rows.log.dq;
  if (reference.empty() || motion.empty()) return out;
  TwoPeaks peaks;
  for (int k = 0; k < rows.log.rows(); ++k)
    peaks.add(rows.log.time[k] > rows.moment_start_s(), std::abs(motion[j][k] - reference[j][k]));
  out.value = peaks.value;
  out.before = peaks.before;
  if (std::isfinite(out.value)) out.state = SignalState::no_range;
  return out;
}

std::vector<StopChannel> relation_channels(const StopRows& rows, const Model& model, int j) {
  std::vector<StopChannel> out;
  for (const SignalRelation& relation : model.relations)
    if (relation.joint == Joint::at(j)) out.push_back(relation_channel(rows, model, relation));
  for (const bool of_position : {true, false}) {
    const StopChannel raw = raw_tracking(rows, model, j, of_position);
    if (raw.state == SignalState::no_range &&
        std::none_of(out.begin(), out.end(), [&](const StopChannel& c) { return c.signal == raw.signal; }))
      out.push_back(raw);
  }
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.signal < b.signal; });
  return out;
}

/// The speed that few rows of the healthy logs exceed, by joint, rad/s or m/s.
double top_speed(const Model& model, int j) {
  return std::visit([j](const auto& robot) { return robot.top_speed[j]; }, model.explain.robot);
}

/// Returns the first time in the last moment at which the magnitude exceeds the limit.
double first_beyond(const StopRows& rows, const std::vector<double>& values, double limit) {
  for (int k = 0; k < rows.log.rows(); ++k)
    if (rows.log.time[k] > rows.moment_start_s() && std::abs(values[k]) > limit) return rows.log.time[k];
  return kNoValue;
}

StopChannel largest_channel(const StopRows& rows, StopSignal signal, const JointSignals& signals, int j,
                            double limit, const char* unit) {
  StopChannel out{.signal = signal, .joint = Joint::at(j), .unit = unit};
  if (signals.empty()) return out;
  TwoPeaks peaks;
  for (int k = 0; k < rows.log.rows(); ++k)
    peaks.add(rows.log.time[k] > rows.moment_start_s(), std::abs(signals[j][k]));
  out.value = peaks.value;
  out.before = peaks.before;
  if (!std::isfinite(out.value)) return out;
  out.limit = limit;
  out.since_s = first_beyond(rows, signals[j], limit);
  out.state = std::isfinite(out.since_s) ? SignalState::changed : SignalState::normal;
  compare_with_before(out);
  return out;
}

StopChannel range_channel(const StopRows& rows, const Model& model, int j, AxisKind axis) {
  StopChannel out{
      .signal = StopSignal::range, .joint = Joint::at(j), .limit = 0.0, .unit = position_unit(axis)};
  TwoPeaks peaks;
  std::vector<double> beyond;
  for (int k = 0; k < rows.log.rows(); ++k) {
    const double q = rows.log.q[j][k];
    beyond.push_back(std::fmax(0.0, std::fmax(q - model.motion.q_high[j], model.motion.q_low[j] - q)));
    if (std::isfinite(q)) peaks.add(rows.log.time[k] > rows.moment_start_s(), beyond.back());
  }
  out.value = peaks.value;
  out.before = peaks.before;
  if (!std::isfinite(out.value)) return out;
  out.since_s = first_beyond(rows, beyond, 0.0);
  out.state = std::isfinite(out.since_s) ? SignalState::changed : SignalState::normal;
  compare_with_before(out);
  return out;
}

}  // namespace

double balance_limit(const ExplainModel& model) { return model.limits.of(FaultKind::unknown); }

std::vector<StopChannel> stop_channels(const StopRows& rows, const Model& model) {
  std::vector<StopChannel> out;
  Residuals residuals;
  const bool has_motion = model.has_mechanics() && !rows.log.tau.empty();
  if (has_motion) {
    ResidualState state;
    residuals = compute_residuals(model.residual, rows.log, state);
  }
  for (int j = 0; j < rows.log.joints(); ++j) {
    const AxisKind axis = model.robot.chain.geometry[j].kind;
    out.push_back(balance_channel(rows, model, j));
    for (StopChannel& channel : motion_channels(rows, model, residuals, j)) out.push_back(std::move(channel));
    for (StopChannel& channel : relation_channels(rows, model, j)) out.push_back(std::move(channel));
    if (!model.has_mechanics()) continue;
    out.push_back(largest_channel(rows, StopSignal::torque, rows.log.tau, j, model.motion.torque_scale[j],
                                  torque_unit(axis)));
    out.push_back(
        largest_channel(rows, StopSignal::speed, rows.log.dq, j, top_speed(model, j), velocity_unit(axis)));
    out.push_back(range_channel(rows, model, j, axis));
  }
  return out;
}

std::vector<double> times_healthy(const std::vector<StopChannel>& channels, int joints) {
  std::vector<double> balance(joints, kNoValue), velocity(joints, kNoValue);
  for (const StopChannel& channel : channels) {
    if (channel.signal == StopSignal::torque_balance) balance[channel.joint.index()] = channel.value;
    if (channel.signal == StopSignal::motion_velocity) velocity[channel.joint.index()] = channel.value;
  }
  const bool has_balance = std::any_of(balance.begin(), balance.end(), [](double v) { return v == v; });
  return has_balance ? balance : velocity;
}

}  // namespace faultline
