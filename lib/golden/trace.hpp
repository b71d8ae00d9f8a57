// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace faultline {

/// The fault-free motion that a model predicts one step ahead, at some rows of a log.
struct Trace {
  std::vector<std::string> channels;        ///< q1 .. qn, dq1 .. dqn
  std::vector<double> time;                 ///< of the predicted row, s
  std::vector<std::vector<double>> values;  ///< [channel][point]; rad, m, rad/s, m/s; NaN = not predicted

  int points() const { return static_cast<int>(time.size()); }
};

/// CSV: t and the channels; numbers with nine significant digits, times in full, nan for a missing number.
std::string trace_to_csv(const Trace& trace);
/// Throws Error(input) for text that is no trace.
Trace trace_from_csv(const std::string& text, const std::string& where);

}  // namespace faultline
