// SPDX-License-Identifier: MIT
#include "lib/golden/trace_tap.hpp"

#include <fmt/format.h>

#include <utility>

namespace faultline {
namespace {

Trace empty_trace(int joints) {
  Trace trace;
  for (const char* quantity : {"q", "dq"})
    for (int j = 0; j < joints; ++j) trace.channels.push_back(fmt::format("{}{}", quantity, Joint::at(j)));
  trace.values.resize(trace.channels.size());
  return trace;
}

Transitions columns_of(const Transitions& all, const std::vector<Eigen::Index>& columns) {
  Transitions some;
  for (const Eigen::Index column : columns) some.row.push_back(all.row[static_cast<std::size_t>(column)]);
  some.time = all.time(columns);
  some.duration = all.duration(columns);
  for_each_matrix(some, all, [&](auto& mine, const auto& theirs) { mine = theirs(Eigen::all, columns); });
  return some;
}

void keep_every_second(std::vector<double>& values) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); i += 2) values[kept++] = values[i];
  values.resize(kept);
}

}  // namespace

TraceTap::TraceTap(LogSource& log, const ResidualGenerator& generator, int max_points)
    : ChangedSource(log),
      generator_(generator),
      max_points_(max_points),
      trace_(empty_trace(generator.joints())) {}

bool TraceTap::next(Log& segment) {
  if (!source_.next(segment)) {
    whole_ = trace_;
    return false;
  }
  take(segment);
  return true;
}

void TraceTap::rewind() {
  source_.rewind();
  state_ = {};
  seen_ = 0;
  stride_ = 1;
  trace_ = empty_trace(generator_.joints());
}

void TraceTap::take(const Log& segment) {
  if (generator_.joints() == 0 || segment.tau.empty()) return;
  const Transitions all = collect_transitions(segment, generator_.shape, state_);
  const std::int64_t before = std::exchange(seen_, seen_ + all.count());
  while ((seen_ + stride_ - 1) / stride_ > max_points_) thin();
  std::vector<Eigen::Index> columns;
  for (std::int64_t i = (stride_ - before % stride_) % stride_; i < all.count(); i += stride_)
    columns.push_back(i);
  keep(columns_of(all, columns));
}

void TraceTap::keep(const Transitions& transitions) {
  Eigen::MatrixXd predicted = predicted_change(generator_, transitions);
  predicted.topRows(generator_.joints()) += transitions.q;
  predicted.bottomRows(generator_.joints()) += transitions.dq;
  for (int i = 0; i < transitions.count(); ++i) {
    trace_.time.push_back(transitions.time[i]);
    for (std::size_t c = 0; c < trace_.values.size(); ++c)
      trace_.values[c].push_back(predicted(static_cast<Eigen::Index>(c), i));
  }
}

void TraceTap::thin() {
  keep_every_second(trace_.time);
  for (auto& values : trace_.values) keep_every_second(values);
  stride_ *= 2;
}

}  // namespace faultline
