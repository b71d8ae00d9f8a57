// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/log/log.hpp"
#include "lib/residual/residual_generator.hpp"

namespace faultline {

/// One quantity of one joint over a whole run.
struct RunSignal {
  std::string quantity;  ///< position, velocity, torque, residual
  int joint = 1;
  std::vector<double> time;  ///< s, from the first row of the run
  std::vector<double> values;
};

/// A run as it is compared.
struct RunSignals {
  std::string name;
  double start_s = 0.0, length_s = 0.0;
  double period_s = 0.0;           ///< median
  std::vector<RunSignal> signals;  ///< of those that the log has, by quantity, then joint
  std::vector<RunSignal> motion;   ///< what runs are aligned by: the references, or else the positions
  bool by_reference = false;       ///< `motion` is the references

  /// Null when the run does not have it.
  const RunSignal* find(const std::string& quantity, int joint) const;
};

/// Of a whole log; with a generator also its normalised velocity residuals (1 as in healthy logs). Throws
/// Error(input) for a log of fewer than a few rows.
RunSignals run_signals(const std::string& name, const Log& log, const ResidualGenerator* generator = nullptr);

/// The same, to be aligned by positions, as when the other run has no references.
RunSignals by_positions(RunSignals run);

}  // namespace faultline
