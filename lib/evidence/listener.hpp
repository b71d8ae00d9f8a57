// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "lib/evidence/episode_evidence.hpp"
#include "lib/evidence/evidence_options.hpp"
#include "lib/evidence/motion_model.hpp"
#include "lib/log/log.hpp"

namespace faultline {

/// Listens to a log and collects the evidence of every episode. The state crosses segment borders; where they
/// fall changes nothing.
class Listener {
 public:
  Listener(const MotionModel& model, const std::vector<Hypothesis>& hypotheses,
           const EvidenceOptions& options);
  ~Listener();

  /// Takes the next rows of the log. An episode is appended when it has been judged; its `end_s` moves on
  /// until the log looks healthy again, so `episodes` must be the same vector all along the log.
  void listen(const Log& segment, std::vector<EpisodeEvidence>& episodes);
  /// After the last row: judges what is open.
  void finish(std::vector<EpisodeEvidence>& episodes);

  /// Alarms that did not last (single wild values), and the largest statistics seen while nothing was
  /// alarmed.
  int rejected_alarms() const;
  double largest_trigger() const;
  double largest_ratio() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace faultline
