// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "lib/compare/run_signals.hpp"

namespace faultline {

/// Method of alignment of the times of two runs.
enum class AlignmentKind {
  automatic,  ///< by motion if that is better than by time
  time,       ///< from the first row of each run
  motion,     ///< by a constant shift of the motion, or a monotone warp if none suits; by positions alone, a
              ///< warp is used for `motion` only, since it would also follow the effect of a fault on them
};

inline constexpr std::array kAlignmentKinds{AlignmentKind::automatic, AlignmentKind::time,
                                            AlignmentKind::motion};
/// Returns auto, time or motion.
const char* to_string(AlignmentKind kind);

/// Assignment of times of the second run to times of the first.
struct RunAlignment {
  AlignmentKind kind = AlignmentKind::time;  ///< never automatic
  double shift_s = 0.0;                      ///< delay of the second run
  std::vector<double> first_s, second_s;  ///< of a warp: increasing, linear interpolation between the points
  double left_rms = 0.0;  ///< rms difference of the aligned motions, in standard deviations of the motion
  double agreeing = 0.0;  ///< share of the time in which the motions agree
  bool parts = false;     ///< positions agree for a while only: one motion, until a fault separates the runs
  bool same_motion = true;
  double uncertain_s = 0.0;  ///< standard deviation of the assigned times
  std::string why;           ///< a sentence

  bool warped() const { return !first_s.empty(); }
  /// Returns s in the second run; NaN before and after a warp.
  double second_at(double first_s_at) const;
  /// Returns seconds of the second run per second of the first.
  double rate_at(double first_s_at) const;
};

/// Both runs must have the same joints and the same kind of motion signals.
RunAlignment align_runs(const RunSignals& first, const RunSignals& second, AlignmentKind wanted);

}  // namespace faultline
