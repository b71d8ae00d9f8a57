// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lib/log/log_source.hpp"
#include "lib/residual/residual_generator.hpp"

namespace faultline {

/// The fault-free motion that a model foretells one step ahead, at some rows of a log.
struct Trace {
  std::vector<std::string> channels;        ///< q1 .. qn, dq1 .. dqn
  std::vector<double> time;                 ///< of the foretold row, s
  std::vector<std::vector<double>> values;  ///< [channel][point]; rad, m, rad/s, m/s; NaN = not foretold

  int points() const { return static_cast<int>(time.size()); }
};

/// A log that hands on another one as it is and keeps the trace of what passes: at most `max_points` points,
/// every prediction of a short log, every second, fourth ... of a longer one.
class TraceTap : public LogSource {
 public:
  TraceTap(LogSource& log, const ResidualGenerator& generator, int max_points);

  bool next(Log& segment) override;
  void rewind() override;
  const LogIdentity& identity() const override { return log_.identity(); }
  const Issues& issues() const override { return log_.issues(); }
  double share_read() const override { return log_.share_read(); }
  const Trace& trace() const { return trace_; }

 private:
  void take(const Log& segment);
  void thin();

  LogSource& log_;
  const ResidualGenerator& generator_;
  int max_points_;
  TransitionState state_;
  std::int64_t seen_ = 0;
  std::int64_t stride_ = 1;
  Trace trace_;
};

/// CSV: t and the channels; numbers with nine significant digits, times in full, nan for a missing number.
std::string trace_to_csv(const Trace& trace);
/// Throws Error(input) for text that is no trace.
Trace trace_from_csv(const std::string& text, const std::string& where);

}  // namespace faultline
