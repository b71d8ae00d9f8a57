// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "lib/evidence/bank.hpp"
#include "lib/evidence/evidence_options.hpp"
#include "lib/evidence/filter/history.hpp"

namespace faultline {

/// One suspicion looked into: every hypothesis restarted from several earlier moments, their log likelihood
/// ratios followed sample by sample until the fault can be named or the suspicion was wrong.
class HypothesisTest {
 public:
  /// Begins at the last sample of the history. `restart` is the first sample that may be used; `repeats` the
  /// length of a run of repeated encoder codes, 0 for none.
  HypothesisTest(const Bank& bank, const History& history, const EvidenceOptions& options,
                 std::int64_t restart, int repeats);

  /// Takes the sample that was just added to the history.
  void advance();
  bool ready() const;
  bool alarmed() const { return alarm_ >= 0; }
  /// The hypothesis without a fault (a misread row, a work piece picked up) that explains the log better than
  /// any fault, or so well that no fault passes the threshold on top of a change of the work piece; null
  /// otherwise.
  const RunningHypothesis* no_fault() const;
  /// The same hypothesis from the onset that explains most: coarse ones are steps of up to 128 samples.
  RunningHypothesis refined(const RunningHypothesis& coarse) const;
  double best_ratio() const { return best_ratio_; }
  /// Whether a fault still explains more than its threshold, with what healthy days imitate of it.
  bool passes() const { return best_counted_ >= options_.threshold; }
  /// A fault that ended while it was looked into is explained until it did, and by nothing after: goes back
  /// to where the alarm stood highest. False where none stood for long enough to be more than wild values.
  bool return_to_peak();
  /// What each hypothesis of the bank explains beyond a change of the work piece, if there was one, nats; 0
  /// for those that explain nothing or were dropped as hopeless.
  std::vector<double> excess_ratios() const;
  double largest_ratio() const { return largest_ratio_; }
  /// The evidence so far, onsets refined for the hypotheses that matter, and the best of them.
  struct Conclusion {
    EpisodeEvidence evidence;
    RunningHypothesis best;
    bool is_over = false;  ///< ended while it was looked into, when the evidence says it was isolated
  };
  Conclusion conclude() const;
  EpisodeEvidence evidence() const { return conclude().evidence; }

 private:
  void begin_at(std::int64_t onset, bool slow_only);
  void update();
  void note_peak();
  double counted(const RunningHypothesis& running) const;
  void prune();
  double margin() const;
  const RunningHypothesis* likeliest() const;
  const RunningHypothesis* work_piece() const;
  bool is_changed(const RunningHypothesis* piece) const;
  bool clearly_healthy() const;
  bool lasts_still() const;
  std::vector<RunningHypothesis> best_of_each() const;
  RunningHypothesis run(int hypothesis, std::int64_t onset) const;
  bool was_dropped(int hypothesis) const;

  const Bank& bank_;
  const History& history_;
  EvidenceOptions options_;
  std::vector<double> imitation_;  ///< a hypothesis of the bank each, nats
  std::int64_t earliest_;          ///< first sample from which a hypothesis can start
  std::int64_t trigger_;
  std::int64_t now_;
  std::int64_t alarm_ = -1;
  bool pruned_ = false;
  bool lost_ = false;  ///< after the alarm the robot ran away from every filter: what came before counts
  double best_ratio_ = 0.0;
  double best_counted_ = 0.0;
  double largest_ratio_ = 0.0;
  std::vector<RunningHypothesis> running_;
  std::vector<RunningHypothesis> before_;   ///< the same a sample ago, once an alarm stands
  std::vector<RunningHypothesis> at_peak_;  ///< the same when the alarm stood highest
  std::int64_t peak_ = -1;
  double peak_counted_ = 0.0;
  std::vector<RunningHypothesis> dropped_;  ///< their ratio is kept as a deficit against the best, below zero
};

}  // namespace faultline
