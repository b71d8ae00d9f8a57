// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/compare/compare_runs.hpp"

/// New runs of a controller against the recorded healthy runs of a golden folder, signal by signal.
namespace faultline {

/// A tolerance that a person made wider, in runs.toml of the golden folder.
struct WidenedTolerance {
  std::string quantity;  ///< position, velocity, torque, residual
  Joint joint{};         ///< none: all joints
  double factor = 1.0;   ///< of the tolerance that the recorded runs give, at least 1
  std::string reason;    ///< a sentence
};

/// Reads [[widen]] tables. Throws Error(usage) for an unknown quantity, a factor below 1 and a missing
/// reason.
std::vector<WidenedTolerance> widened_tolerances(const std::string& text, const std::string& where);

/// One signal of a new run.
struct SignalCheck {
  std::string quantity;
  Joint joint = 1_joint;
  const char* unit = "";
  double largest = std::numeric_limits<double>::quiet_NaN();    ///< difference to the recorded run, signed
  double largest_s = std::numeric_limits<double>::quiet_NaN();  ///< its time in the recorded run, s
  double tolerance = 0.0;  ///< the difference that recorded runs have among themselves, or their noise
  double leaves_s = std::numeric_limits<double>::quiet_NaN();  ///< NaN: stays within the tolerance
  std::string reason{};                                        ///< of a wider tolerance; empty without one
  bool judged = true;                                          ///< as SignalDifference::judged
};

/// A new run against the nearest recorded run of the same motion.
struct NewRunCheck {
  std::string log;
  std::string nearest{};  ///< the recorded run; empty: none has this motion
  int recorded = 0;       ///< healthy runs of the same motion in the folder
  RunAlignment alignment{};
  std::vector<SignalCheck> signals{};

  /// Returns the signal that leaves its tolerance first; null if none does.
  const SignalCheck* first_leaving() const;
  bool same() const { return !nearest.empty() && !first_leaving(); }
};

/// Returns the tolerance in units of the largest difference among so many recorded runs, at least two. Few
/// runs show less than all: where runs differ by one normal effect, a new run leaves this tolerance of its
/// nearest recorded run in one case of 100. At least 1.
double few_runs_factor(int recorded);

/// Compares a run with recorded healthy ones. Of those with its motion, the one is taken that it resembles
/// most. The tolerance of a signal is the largest difference that these recorded runs have among themselves
/// times few_runs_factor(), and never below their noise.
/// `turns` as for unit_of(). Throws Error(input) as compare_runs().
NewRunCheck check_new_run(const RunSignals& run, const std::vector<RunSignals>& recorded,
                          const std::vector<WidenedTolerance>& widened, const std::vector<char>& turns);

/// Lines for a terminal.
std::string to_text(const std::vector<NewRunCheck>& runs);
/// Schema "faultline/golden-runs/1".
std::string new_runs_json(const std::vector<NewRunCheck>& runs);
/// A test suite for each run with a case for each signal.
std::string new_runs_junit(const std::vector<NewRunCheck>& runs);

}  // namespace faultline
