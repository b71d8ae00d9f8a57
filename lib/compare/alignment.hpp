// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/compare/run_signals.hpp"

namespace faultline {

/// How times of two runs are brought together.
enum class AlignmentKind {
  automatic,  ///< motion where that is better than time
  time,       ///< each from its first row
  motion,     ///< by the motion: a constant shift, or a monotone warp where none suits; by positions alone a
              ///< warp is taken for `motion` only, since it would follow what a fault does to them, too
};

/// Which time of the second run belongs to a time of the first.
struct RunAlignment {
  AlignmentKind kind = AlignmentKind::time;  ///< never automatic
  double shift_s = 0.0;                      ///< the second run is later by it
  std::vector<double> first_s, second_s;     ///< of a warp: increasing, points in between by straight lines
  double left_rms = 0.0;  ///< of the motions' difference then, in shares of how far the motion goes
  double agreeing = 0.0;  ///< share of the time in which the motions agree
  bool parts = false;     ///< positions that agree for a while only: one motion, until a fault parts the runs
  bool same_motion = true;
  double uncertain_s = 0.0;  ///< how far times may be off, standard deviation
  std::string why;           ///< a sentence

  bool warped() const { return !first_s.empty(); }
  /// s in the second run; NaN before a warp begins and after it ends.
  double second_at(double first_s_at) const;
  /// Seconds of the second run a second of the first.
  double rate_at(double first_s_at) const;
};

/// Both runs have the same joints and are aligned by the same signals.
RunAlignment align_runs(const RunSignals& first, const RunSignals& second, AlignmentKind wanted);

}  // namespace faultline
