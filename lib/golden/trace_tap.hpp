// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "lib/golden/observation.hpp"
#include "lib/log/transformed/changed_source.hpp"
#include "lib/residual/residual_generator.hpp"

namespace faultline {

/// A log that hands on another one as it is and keeps the trace of what passes: at most `max_points` points,
/// every prediction of a short log, every second, fourth ... of a longer one. Only what is kept is predicted.
class TraceTap : public ChangedSource {
 public:
  TraceTap(LogSource& log, const ResidualGenerator& generator, int max_points);

  bool next(Log& segment) override;
  void rewind() override;
  /// Of the latest pass that reached the end of the log; empty before the first one has.
  const Trace& trace() const { return whole_; }

 private:
  void take(const Log& segment);
  void keep(const Transitions& transitions);
  void thin();

  const ResidualGenerator& generator_;
  int max_points_;
  TransitionState state_;
  std::int64_t seen_ = 0;  ///< transitions
  std::int64_t stride_ = 1;
  Trace trace_;  ///< of the present pass
  Trace whole_;
};

}  // namespace faultline
