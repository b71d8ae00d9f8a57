// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lib/evidence/episode_evidence.hpp"
#include "lib/evidence/evidence_options.hpp"
#include "lib/evidence/motion_model.hpp"
#include "lib/evidence/slow_estimate.hpp"
#include "lib/evidence/watch/slow_watch.hpp"
#include "lib/evidence/watch/work_piece_change.hpp"
#include "lib/log/log.hpp"

namespace faultline {

/// Finds the stretches of a log that the healthy robot does not explain, with what each hypothesis of the
/// bank makes of them. The state crosses segment borders; where they fall changes nothing.
class EpisodeDetector {
 public:
  EpisodeDetector(const MotionModel& model, const std::vector<Hypothesis>& hypotheses,
                  const EvidenceOptions& options, const LogNoise& noise = {});
  ~EpisodeDetector();

  /// Takes the next rows of the log.
  void take(const Log& segment);
  /// After the last row: names what is open.
  void finish();

  /// Those that could be named so far, by alarm. The `end_s` of the last one moves on until the log looks
  /// healthy again.
  const std::vector<EpisodeEvidence>& episodes() const;
  const std::vector<WorkPieceChange>& work_piece_changes() const;
  /// What the log tells of the healthy robot's slow states so far; empty before any row.
  std::vector<SlowEstimate> slow_estimates() const;
  /// Those that left their normal range far behind while no other fault was there.
  const std::vector<SlowFault>& slow_faults() const;
  /// Alarms that did not last (single wild values), and the largest statistics seen while nothing was
  /// alarmed.
  int rejected_alarms() const;
  double largest_trigger() const;
  double largest_ratio() const;
  /// With EvidenceOptions::only_measure: the most that each hypothesis explained; empty for nothing.
  const std::vector<double>& largest_ratios() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace faultline
