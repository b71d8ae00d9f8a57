// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "lib/core/progress.hpp"
#include "lib/identify/identification.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

struct IdentifyOptions {
  IdentifyMethod method = IdentifyMethod::automatic;
  int max_rows = 40000;     ///< rows that shooting uses, spread over all logs
  int max_iterations = 40;  ///< of each least-squares solve
  bool keep_all = false;    ///< keeps logs that disagree with the others
  int threads = 0;          ///< 0: one per core; the result does not depend on it

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
