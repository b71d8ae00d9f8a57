// SPDX-License-Identifier: MIT
#include "lib/residual/transitions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

void check(const Log& segment, const TransitionShape& shape) {
  const auto has = [&](const JointSignals& signals) {
    return static_cast<int>(signals.size()) == shape.joints;
  };
  if (!has(segment.q) || !has(segment.tau) || !(shape.derive_velocity || has(segment.dq)))
    throw Error(
        ErrorCode::input, fmt::format("row {}", segment.first_row + 1),
        fmt::format("the log has {} positions, {} velocities and {} torques; the residual generator was "
                    "learned on {} joints with {}",
                    segment.q.size(), segment.dq.size(), segment.tau.size(), shape.joints,
                    shape.derive_velocity ? "positions and torques" : "positions, velocities and torques"));
}

void append_rows(Log& rows, const Log& more, int begin, bool with_velocity) {
  const auto extend = [&](std::vector<double>& mine, const std::vector<double>& theirs) {
    mine.insert(mine.end(), theirs.begin() + begin, theirs.end());
  };
  extend(rows.time, more.time);
  for (std::size_t j = 0; j < more.q.size(); ++j) {
    extend(rows.q[j], more.q[j]);
    extend(rows.tau[j], more.tau[j]);
    if (with_velocity) extend(rows.dq[j], more.dq[j]);
  }
}

Log no_rows(const TransitionShape& shape) {
  Log rows;
  rows.q.resize(shape.joints);
  rows.tau.resize(shape.joints);
  if (!shape.derive_velocity) rows.dq.resize(shape.joints);
  return rows;
}

Transitions sized(int joints, int count) {
  Transitions out;
  out.row.resize(count);
  out.time.resize(count);
  out.duration.resize(count);
  for_each_matrix(out, out, [&](auto& matrix, const auto&) { matrix.resize(joints, count); });
  return out;
}

double velocity(const Log& rows, const TransitionShape& shape, int j, int i) {
  if (!shape.derive_velocity) return rows.dq[j][i];
  return (rows.q[j][i] - rows.q[j][i - shape.step]) / (rows.time[i] - rows.time[i - shape.step]);
}

/// Mean torque over a pair, always summed from its start, so that it does not depend on segment borders.
double mean_torque(const std::vector<double>& tau, int from, int step, double phi) {
  double sum = 0.0;
  for (int i = from; i < from + step; ++i) sum += tau[i] + phi * (tau[i + 1] - tau[i]);
  return sum / step;
}

void fill(Transitions& out, int column, const Log& rows, const TransitionShape& shape, int from) {
  const int to = from + shape.step;
  const double duration = rows.time[to] - rows.time[from];
  const bool regular = std::fabs(duration - shape.step_s) <= 0.25 * shape.step_s;
  out.time[column] = rows.time[to];
  out.duration[column] = regular ? duration : std::numeric_limits<double>::quiet_NaN();
  for (int j = 0; j < shape.joints; ++j) {
    out.q(j, column) = rows.q[j][from];
    out.dq(j, column) = velocity(rows, shape, j, from);
    out.tau(j, column) = rows.tau[j][from];
    out.mean_tau(j, column) = mean_torque(rows.tau[j], from, shape.step, shape.torque_phi);
    out.next_q(j, column) = rows.q[j][to];
    out.next_dq(j, column) = velocity(rows, shape, j, to);
  }
}

}  // namespace

Transitions collect_transitions(const Log& segment, const TransitionShape& shape, TransitionState& state) {
  check(segment, shape);
  if (state.rows_seen == 0) state.tail = no_rows(shape);
  Log rows = std::move(state.tail);
  const std::int64_t first = state.rows_seen - rows.rows();  // absolute number of rows' first row
  append_rows(rows, segment, 0, !shape.derive_velocity);

  const std::int64_t history = shape.derive_velocity ? shape.step : 0;  // rows needed before a pair
  std::int64_t start = std::max<std::int64_t>(history, state.rows_seen - shape.step);
  start = (start + shape.stride - 1) / shape.stride * shape.stride;
  state.rows_seen += segment.rows();
  const std::int64_t pairs =
      std::max<std::int64_t>(0, (state.rows_seen - shape.step - start + shape.stride - 1) / shape.stride);
  Transitions out = sized(shape.joints, static_cast<int>(pairs));
  for (int column = 0; column < out.count(); ++column, start += shape.stride) {
    out.row[column] = start + shape.step;
    fill(out, column, rows, shape, static_cast<int>(start - first));
  }
  state.tail = no_rows(shape);
  append_rows(state.tail, rows,
              static_cast<int>(std::max<std::int64_t>(0, rows.rows() - shape.step - history)),
              !shape.derive_velocity);
  return out;
}

Transitions joined(const Transitions& first, const Transitions& second) {
  Transitions all = first;
  all.row.insert(all.row.end(), second.row.begin(), second.row.end());
  all.time.conservativeResize(all.count());
  all.time.tail(second.count()) = second.time;
  all.duration.conservativeResize(all.count());
  all.duration.tail(second.count()) = second.duration;
  for_each_matrix(all, second, [](Eigen::MatrixXd& mine, const Eigen::MatrixXd& more) {
    const Eigen::Index before = mine.cols();
    mine.conservativeResize(Eigen::NoChange, before + more.cols());
    mine.rightCols(more.cols()) = more;
  });
  return all;
}

void TransitionReservoir::offer(const Transitions& transitions, int column) {
  if (offered_ == 0) pool_ = sized(static_cast<int>(transitions.q.rows()), capacity_);
  ++offered_;
  const std::int64_t place = kept_ < capacity_ ? kept_++ : static_cast<std::int64_t>(random_.below(offered_));
  if (place >= capacity_) return;
  pool_.row[place] = transitions.row[column];
  pool_.time[place] = transitions.time[column];
  pool_.duration[place] = transitions.duration[column];
  for_each_matrix(pool_, transitions,
                  [&](auto& mine, const auto& theirs) { mine.col(place) = theirs.col(column); });
}

Transitions TransitionReservoir::drawn() const {
  Transitions out = pool_;
  out.row.resize(kept_);
  out.time.conservativeResize(kept_);
  out.duration.conservativeResize(kept_);
  for_each_matrix(out, pool_,
                  [&](auto& mine, const auto&) { mine.conservativeResize(Eigen::NoChange, kept_); });
  return out;
}

}  // namespace faultline
