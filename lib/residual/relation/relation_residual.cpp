// SPDX-License-Identifier: MIT
#include "lib/residual/relation/relation_residual.hpp"

#include <algorithm>
#include <cmath>

#include "lib/log/log.hpp"

namespace faultline {
namespace {

constexpr double kGap = 1.75;    // periods: in a longer step between two rows, a row is missing
constexpr int kMostBridged = 5;  // missing rows in succession that are interpolated, at most

constexpr double kSettle_s = 0.15;  // not judged after an input outside the learned range, such as a jump

}  // namespace

LagLine::LagLine(const SignalRelation& relation)
    : relation_(relation),
      reach_(static_cast<std::size_t>(relation.lags) * relation.stride),
      before_(relation.inputs.size() * (reach_ + 1)),
      terms_(relation.weights_needed(), 1.0) {}

/// The input as a target with this rate limit follows it, from the present value of the target on.
double LagLine::followed(double input, const Log& log, int row, double dt) {
  if (relation_.rate_limit <= 0.0) return input;
  const double target = signals_of(log, relation_.target)[relation_.joint.index()][row];
  if (rows_ == 0 || !std::isfinite(followed_)) followed_ = std::isfinite(target) ? target : input;
  const double most = relation_.rate_limit * std::min(dt, (kMostBridged + 1) * relation_.period_s);
  followed_ += std::clamp(input - followed_, -most, most);
  return followed_;
}

void LagLine::push(std::size_t input, double value) {
  double* line = &before_[input * (reach_ + 1)];
  std::copy_backward(line, line + reach_, line + reach_ + 1);
  line[0] = value;
}

bool LagLine::take(const Log& log, int row) {
  const double dt = log.time[row] - last_s_;
  last_s_ = log.time[row];
  const bool in_step = dt > 0.0 && dt < kGap * relation_.period_s;
  const bool bridges = relation_.kind == RelationKind::tracking;
  const double lost = in_step || !bridges ? 0.0 : std::round(dt / relation_.period_s) - 1.0;
  if (!in_step && !(lost >= 1.0 && lost <= kMostBridged)) rows_ = 0;
  const int bridged = rows_ == 0 ? 0 : static_cast<int>(lost);
  const std::size_t kept = reach_ + 1;
  for (std::size_t i = 0; i < relation_.inputs.size(); ++i) {
    double value = signals_of(log, relation_.inputs[i])[relation_.joint.index()][row];
    if (!std::isfinite(value)) {
      rows_ = 0;
      return false;
    }
    if (i == 0) value = followed(value, log, row, dt);
    const double before = before_[i * kept];
    for (int b = 1; b <= bridged; ++b) push(i, before + (value - before) * b / (bridged + 1));
    push(i, value);
  }
  rows_ += bridged;
  if (++rows_ <= static_cast<int>(reach_)) return false;
  for (std::size_t i = 0; i < relation_.inputs.size(); ++i) {
    const double* line = &before_[i * kept];
    double* terms = &terms_[i * (relation_.lags + 1)];
    terms[0] = line[0];
    for (int l = 0; l < relation_.lags; ++l)
      terms[l + 1] = line[l * relation_.stride] - line[(l + 1) * relation_.stride];
  }
  return true;
}

bool RelationResidual::terms_are_known() const {
  // The position of a joint does not change how it follows its reference.
  const bool anywhere = relation_.kind == RelationKind::tracking && relation_.target == Quantity::q;
  for (std::size_t i = anywhere ? 1 : 0; i < relation_.term_low.size(); ++i) {
    const double term = line_.terms()[i];
    if (term < relation_.term_low[i] || term > relation_.term_high[i]) return false;
  }
  return true;
}

std::optional<RelationSample> RelationResidual::take(const Log& log, int row) {
  const double target = signals_of(log, relation_.target)[relation_.joint.index()][row];
  if (!line_.take(log, row)) return std::nullopt;
  if (!terms_are_known()) {
    if (std::isfinite(unknown_s_) && log.time[row] - unknown_s_ < kSettle_s)
      beyond_s_ += log.time[row] - unknown_s_;
    unknown_s_ = log.time[row];
  }
  if (!std::isfinite(target) || log.time[row] - unknown_s_ < kSettle_s) return std::nullopt;
  double predicted = 0.0;
  double by_command = 0.0;
  const std::size_t of_command = relation_.lags + 1;
  for (std::size_t i = 0; i < relation_.weights.size(); ++i) {
    predicted += relation_.weights[i] * line_.terms()[i];
    if (i < of_command) by_command = predicted;
  }
  const bool drive = relation_.kind == RelationKind::actuator,
             motion = relation_.kind == RelationKind::tracking;
  double by_speed = drive ? predicted - by_command - relation_.weights.back() : 0.0;
  if (motion && std::isfinite(last_predicted_)) by_speed = predicted - last_predicted_;
  last_predicted_ = predicted;
  return RelationSample{log.time[row], line_.terms().front(), predicted, by_speed,
                        residual(target, predicted)};
}

/// Target minus prediction. A drive may not reach a predicted torque beyond the range of the healthy logs:
/// the residual is 0 from that range to the prediction, and if target and prediction are both beyond.
double RelationResidual::residual(double target, double predicted) const {
  if (relation_.kind == RelationKind::tracking) return target - predicted;
  const double reachable = std::clamp(predicted, relation_.low, relation_.high);
  const bool above = target >= relation_.high && predicted >= relation_.high;
  const bool below = target <= relation_.low && predicted <= relation_.low;
  if (above || below) return 0.0;
  return target - std::clamp(target, std::min(predicted, reachable), std::max(predicted, reachable));
}

WindowedMeans::WindowedMeans(std::vector<int> rows)
    : rows_(std::move(rows)), ring_(rows_.back()), sum_(rows_.size()) {}

void WindowedMeans::add(double value, double time_s) {
  if (time_s - last_s_ > 0.2) restart();
  last_s_ = time_s;
  for (std::size_t w = 0; w < rows_.size(); ++w) {
    const std::size_t size = ring_.size();
    sum_[w] += value;
    if (count_ >= rows_[w]) sum_[w] -= ring_[(next_ + size - rows_[w]) % size];
  }
  ring_[next_] = value;
  next_ = (next_ + 1) % ring_.size();
  ++count_;
  if (next_ != 0) return;  // once a round the sums are recomputed, so that rounding errors do not add up
  for (std::size_t w = 0; w < rows_.size(); ++w) {
    sum_[w] = 0.0;
    for (int k = 1; k <= std::min<long long>(rows_[w], count_); ++k) sum_[w] += ring_[ring_.size() - k];
  }
}

void WindowedMeans::restart() {
  std::fill(sum_.begin(), sum_.end(), 0.0);
  next_ = 0;
  count_ = 0;
}

int WindowedMeans::full() const {
  return static_cast<int>(
      std::count_if(rows_.begin(), rows_.end(), [&](int rows) { return count_ >= rows; }));
}

std::vector<int> window_rows(std::span<const double> windows_s, double period_s) {
  std::vector<int> rows;
  for (const double window_s : windows_s)
    rows.push_back(std::max(1, static_cast<int>(std::lround(window_s / period_s))));
  return rows;
}

}  // namespace faultline
