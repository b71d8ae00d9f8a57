// SPDX-License-Identifier: MIT
#include "lib/evidence/episode_detector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "lib/evidence/bank.hpp"
#include "lib/evidence/filter/history.hpp"
#include "lib/evidence/hypothesis_test.hpp"
#include "lib/evidence/trigger.hpp"

namespace faultline {

/// Watching: the healthy filter and the trigger run. Testing: the bank of hypotheses runs too. Faulty: a
/// fault was named and the log still looks faulty; only its end is looked for.
class EpisodeDetector::Impl {
 public:
  Impl(const MotionModel& model, const std::vector<Hypothesis>& hypotheses, const EvidenceOptions& options,
       const LogNoise& noise)
      : options_(options),
        follower_(model, noise),
        trigger_(model),
        bank_(model, follower_.dynamics(), hypotheses),
        history_(kHistory) {}

  void take(const Log& segment, int row) {
    FollowedSample& sample = history_.push();
    follower_.follow(segment, row, sample);
    if (sample.dt <= 0.0) {
      interrupt();
      restart_ = history_.last();
    }
    const double statistic = trigger_.take(sample);
    const int repeats = trigger_.repeated_codes();
    const bool suspicious = statistic > options_.trigger || repeats >= kSuspiciousRepeats;
    switch (mode_) {
      case Mode::watching:
        watch(sample, statistic, repeats, suspicious);
        break;
      case Mode::testing:
        test();
        break;
      case Mode::faulty:
        look_for_end(sample, suspicious);
        break;
    }
    last_time_s_ = sample.time;
    last_row_ = sample.row;
  }

  void finish() { interrupt(); }

  std::vector<EpisodeEvidence> episodes;
  std::vector<WorkPieceChange> work_piece_changes;
  int rejected_alarms = 0;
  double largest_trigger = 0.0;
  double largest_ratio = 0.0;

 private:
  enum class Mode { watching, testing, faulty };
  static constexpr int kHistory = 4096;  // samples that a test can look back over
  static constexpr int kRearm = 64;      // samples for which a rejected suspicion is old news
  static constexpr double kNewSuspicion =
      1.3;                              // times the statistic that was looked into makes it news again
  static constexpr double kCalm = 0.7;  // of the trigger: below it the range seen is healthy

  void watch(const FollowedSample& sample, double statistic, int repeats, bool suspicious) {
    // A statistic that a rejected suspicion already looked into is old news until it grows or decays.
    if (sample.row < rearm_row_ && statistic < kNewSuspicion * looked_into_ && repeats != kSuspiciousRepeats)
      return;
    largest_trigger = std::max(largest_trigger, statistic);
    if (statistic < kCalm * options_.trigger) follower_.learn_range(sample);
    if (!suspicious) return;
    looked_into_ = statistic;
    test_.emplace(bank_, history_, options_, restart_, repeats);
    mode_ = Mode::testing;
  }

  void test() {
    test_->advance();
    if (test_->ready()) conclude(history_.back().time, history_.back().row);
  }

  /// Names the fault, or lets the suspicion go when its evidence did not last.
  void conclude(double time_s, std::int64_t row) {
    mode_ = Mode::watching;
    rearm_row_ = row + kRearm;
    if (const RunningHypothesis* no_fault = test_->no_fault()) {
      go_on_from(*no_fault);
    } else if (!test_->alarmed()) {
      largest_ratio = std::max(largest_ratio, test_->largest_ratio());
    } else if (test_->best_ratio() < options_.threshold) {
      ++rejected_alarms;
    } else {
      HypothesisTest::Conclusion found = test_->conclude();
      if (is_healthy(bank_.hypotheses()[found.best.hypothesis]))
        go_on_from(found.best);
      else
        open_episode(std::move(found.evidence), time_s);
    }
    test_.reset();
  }

  void open_episode(EpisodeEvidence evidence, double time_s) {
    episodes.push_back(std::move(evidence));
    episodes.back().end_s = last_faulty_s_ = time_s;
    rearm_row_ = -1;
    mode_ = Mode::faulty;
  }

  /// The robot is healthy all the same. Filters before a change of the work piece know nothing of it.
  void go_on_from(const RunningHypothesis& no_fault) {
    follower_.restore(no_fault.state);
    const Hypothesis& hypothesis = bank_.hypotheses()[no_fault.hypothesis];
    if (is_misread(hypothesis)) {
      rejected_alarms += test_->alarmed();
      return;
    }
    restart_ = history_.last();
    trigger_.forget();
    work_piece_changes.push_back({history_[no_fault.onset].row, hypothesis.work_piece_kg});
  }

  void look_for_end(const FollowedSample& sample, bool suspicious) {
    if (suspicious) episodes.back().end_s = last_faulty_s_ = sample.time;
    if (sample.time - last_faulty_s_ > options_.recover_s) mode_ = Mode::watching;
  }

  /// The filter started anew (a gap) or the log ended: what is open is decided with what there is.
  void interrupt() {
    if (mode_ == Mode::testing) conclude(last_time_s_, last_row_);
    mode_ = Mode::watching;
  }

  EvidenceOptions options_;
  Follower follower_;
  Trigger trigger_;
  Bank bank_;
  History history_;
  Mode mode_ = Mode::watching;
  std::optional<HypothesisTest> test_;
  double last_faulty_s_ = 0.0;
  double last_time_s_ = 0.0;
  std::int64_t last_row_ = 0;
  std::int64_t restart_ = 0;  ///< number of the sample at which the filter last started anew
  double looked_into_ = 0.0;
  std::int64_t rearm_row_ = -1;
};

EpisodeDetector::EpisodeDetector(const MotionModel& model, const std::vector<Hypothesis>& hypotheses,
                                 const EvidenceOptions& options, const LogNoise& noise)
    : impl_(std::make_unique<Impl>(model, hypotheses, options, noise)) {}
EpisodeDetector::~EpisodeDetector() = default;

void EpisodeDetector::take(const Log& segment) {
  for (int row = 0; row < segment.rows(); ++row) impl_->take(segment, row);
}

void EpisodeDetector::finish() { impl_->finish(); }
const std::vector<EpisodeEvidence>& EpisodeDetector::episodes() const { return impl_->episodes; }
const std::vector<WorkPieceChange>& EpisodeDetector::work_piece_changes() const {
  return impl_->work_piece_changes;
}
int EpisodeDetector::rejected_alarms() const { return impl_->rejected_alarms; }
double EpisodeDetector::largest_trigger() const { return impl_->largest_trigger; }
double EpisodeDetector::largest_ratio() const { return impl_->largest_ratio; }

}  // namespace faultline
