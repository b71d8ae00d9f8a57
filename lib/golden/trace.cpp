// SPDX-License-Identifier: MIT
#include "lib/golden/trace.hpp"

#include <fmt/format.h>

#include <utility>

namespace faultline {
namespace {

Trace empty_trace(int joints) {
  Trace trace;
  for (const char* quantity : {"q", "dq"})
    for (int joint = 1; joint <= joints; ++joint)
      trace.channels.push_back(fmt::format("{}{}", quantity, joint));
  trace.values.resize(trace.channels.size());
  return trace;
}

void keep_every_second(std::vector<double>& values) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); i += 2) values[kept++] = values[i];
  values.resize(kept);
}

}  // namespace

TraceTap::TraceTap(LogSource& log, const ResidualGenerator& generator, int max_points)
    : log_(log), generator_(generator), max_points_(max_points), trace_(empty_trace(generator.joints())) {}

bool TraceTap::next(Log& segment) {
  if (!log_.next(segment)) return false;
  take(segment);
  return true;
}

void TraceTap::rewind() {
  log_.rewind();
  state_ = {};
  seen_ = 0;
  stride_ = 1;
  trace_ = empty_trace(generator_.joints());
}

void TraceTap::take(const Log& segment) {
  const Transitions transitions = collect_transitions(segment, generator_.shape, state_);
  Eigen::MatrixXd foretold = predicted_change(generator_, transitions);
  foretold.topRows(generator_.joints()) += transitions.q;
  foretold.bottomRows(generator_.joints()) += transitions.dq;
  for (int i = 0; i < transitions.count(); ++i) {
    if (seen_++ % stride_ != 0) continue;
    trace_.time.push_back(transitions.time[i]);
    for (std::size_t c = 0; c < trace_.values.size(); ++c)
      trace_.values[c].push_back(foretold(static_cast<Eigen::Index>(c), i));
    if (trace_.points() > max_points_) thin();
  }
}

void TraceTap::thin() {
  keep_every_second(trace_.time);
  for (auto& values : trace_.values) keep_every_second(values);
  stride_ *= 2;
}

}  // namespace faultline
