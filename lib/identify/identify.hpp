// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "lib/core/progress.hpp"
#include "lib/identify/identification.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

struct IdentifyOptions {
  IdentifyMethod method = IdentifyMethod::automatic;
  double window_s = 0.04;       ///< length of a weak-form window; at least one sample
  double segment_s = 0.25;      ///< length of a shooting segment on logs of 100 Hz and above
  int min_segment_rows = 8;     ///< rows of a shooting segment on slower logs
  int max_rows = 40000;         ///< rows that shooting uses, spread over all logs
  int max_windows = 6000;       ///< windows that the weak form keeps, spread over all logs
  int max_iterations = 40;      ///< of each least-squares solve
  bool estimate_offset = true;  ///< friction offset, bend and skew, if they lower the held-out error
  bool estimate_width = true;   ///< friction width; prior: that of the robot file within a factor of about 3
  bool keep_all = false;        ///< keeps logs that disagree with the others
  int threads = 0;              ///< 0: one per core; the result does not depend on it

  /// Throws Error(usage) naming the field, its value and its bound.
  void check() const;
};

/// Identifies `robot` from logs of healthy runs (docs/how-it-works.md): a weak-form regression for a start,
/// then output error by multiple shooting. Facts in robot.known are kept. Logs whose file name is in
/// robot.payloads carry that mass: they determine masses and lengths, and the identified robot is without
/// payload. Each log is read from its start, more than once. Throws Error(input) if the logs have too few
/// rows, every log carries a payload, or a log has other joints than the robot.
Identification identify(std::span<LogSource* const> logs, const Robot& robot,
                        const IdentifyOptions& options = {}, const Progress& progress = {});

}  // namespace faultline
