// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "lib/evidence/bank.hpp"
#include "lib/evidence/evidence_options.hpp"
#include "lib/evidence/filter/history.hpp"
#include "lib/evidence/hypothesis_test.hpp"
#include "lib/evidence/trigger.hpp"
#include "lib/evidence/watch/faulty_robot.hpp"
#include "lib/evidence/watch/work_piece_change.hpp"

namespace faultline {

/// Follows a log with one robot, healthy or with the faults that were named, and tests the bank where that
/// robot does not explain it.
class Watch {
 public:
  Watch(const MotionModel& model, const std::vector<Hypothesis>& hypotheses, const EvidenceOptions& options,
        const LogNoise& noise);
  /// Goes on from the last sample of another watch, with another robot and the state of its filter.
  Watch(const Watch& before, FaultyRobot robot, const GaussianState& state, const EvidenceOptions& options);
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  /// Follows the next row.
  void follow(const Log& segment, int row);
  /// What this row brought to light: the fault that could be named, if any.
  std::optional<HypothesisTest::Conclusion> look();
  /// The log ended here, or goes on after a gap: what is open is decided with what there is.
  std::optional<HypothesisTest::Conclusion> interrupt();
  /// From the sample `onset` on the log tells of another robot: what this one is like is kept as it was.
  void stand_by(std::int64_t onset);
  /// While standing by: the joints are where the other robot's filter has them.
  void move_with(const GaussianState& motion);
  /// Rows so far were another's to judge: tests do not look back at them.
  void begin_anew();
  /// A fault that began at that sample was over before it was named: goes on with the motion of now and what
  /// was known before it.
  void go_on_healed(std::int64_t onset);
  /// The fault was over by itself: goes on from its state.
  void go_on_after(const RunningHypothesis& passed);

  const FaultyRobot& robot() const { return robot_; }
  const FollowedSample& sample() const { return history_.back(); }
  /// The last state that is this robot's own: while standing by, the one from before. None before any row.
  const GaussianState* own_state() const {
    if (kept_) return &*kept_;
    return history_.last() < 0 ? nullptr : &history_.back().posterior;
  }
  /// False where the filter lost the robot altogether.
  bool is_sound() const;
  bool suspicious() const;
  /// What the best fault explains of the suspicion that is being looked into, nats; 0 for none.
  double ratio() const { return test_ ? test_->best_ratio() : 0.0; }
  const std::vector<WorkPieceChange>& work_piece_changes() const { return work_piece_changes_; }
  int rejected_alarms() const { return rejected_alarms_; }
  double largest_trigger() const { return largest_trigger_; }
  double largest_ratio() const { return largest_ratio_; }
  /// The most that each hypothesis explained where faults were measured and not named; empty where nothing
  /// passed the threshold.
  const std::vector<double>& largest_ratios() const { return largest_ratios_; }

 private:
  static constexpr int kHistory = 4096;  // samples that a test can look back over
  static constexpr int kRearm = 64;      // samples for which a rejected suspicion is old news
  static constexpr double kNewSuspicion =
      1.3;                                  // times the statistic that was looked into makes it news again
  static constexpr double kOutgrown = 3.0;  // times it: another thing has begun meanwhile
  static constexpr double kMoved = 30.0;    // times the noise of its reading: a joint that does not rest
  static constexpr double kCalm = 0.7;      // of the trigger: below it the range seen is healthy

  void watch();
  /// Tests from this row back.
  void test_now();
  /// Whether what is being looked into without an alarm is small against what shows now.
  bool is_outgrown() const {
    return !test_->alarmed() && statistic_ > kOutgrown * std::max(looked_into_, options_.trigger);
  }
  std::optional<HypothesisTest::Conclusion> conclude();
  bool has_ended(const RunningHypothesis& best) const;
  /// None where it is no fault all the same.
  std::optional<HypothesisTest::Conclusion> name(bool is_over);
  void measure();
  void go_on_from(const RunningHypothesis& no_fault);

  FaultyRobot robot_;
  EvidenceOptions options_;
  Follower follower_;
  Trigger trigger_;
  Bank bank_;
  History history_;
  std::optional<HypothesisTest> test_;
  double statistic_ = 0.0;
  bool may_learn_range_ = true;  ///< where a fault leads a joint, such as onto its stop, is no healthy place
  std::optional<GaussianState> kept_;  ///< while standing by
  std::int64_t restart_ = 0;           ///< number of the sample at which the filter last started anew
  double looked_into_ = 0.0;
  std::int64_t rearm_row_ = -1;
  std::vector<WorkPieceChange> work_piece_changes_;
  int rejected_alarms_ = 0;
  double largest_trigger_ = 0.0;
  double largest_ratio_ = 0.0;
  std::vector<double> largest_ratios_;
};

}  // namespace faultline
