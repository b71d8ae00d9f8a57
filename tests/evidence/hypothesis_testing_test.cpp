// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "lib/evidence/hypothesis_test.hpp"
#include "lib/evidence/trigger.hpp"
#include "lib/fault/label_text.hpp"
#include "tests/support/hand_made_model.hpp"

namespace faultline {
namespace {

constexpr int kMovingRow = 240;  // of the healthy log: a joint at rest would look locked
constexpr double kOnset_s = 2.503, kPeriod_s = 0.01;
constexpr std::array<int, 9> kNearOffsets = {0, 1, 2, 3, 4, 6, 8, 12, 16};

/// A log fed to the follower; a test begins at the first sample after `from_s` that wakes the trigger.
class Watch {
 public:
  explicit Watch(const Log& log, const EvidenceOptions& options = {}, std::int64_t capacity = 1024)
      : log_(log), options_(options), history_(capacity) {}

  /// Takes rows until the trigger wakes (or `at_row` comes, if it is given); false at the end of the log.
  bool wake(int at_row = -1) {
    while (row_ < log_.rows()) {
      const double statistic = take();
      if (at_row < 0 ? statistic <= options_.trigger : row_ <= at_row) continue;
      test_.emplace(bank_, history_, options_, 0, 0);
      trigger_row_ = row_ - 1;
      return true;
    }
    return false;
  }
  void advance(int rows = 1) {
    for (; rows > 0 && row_ < log_.rows(); --rows) {
      take();
      test_->advance();
    }
  }
  /// Samples after the trigger until the test is ready.
  int rows_until_ready() {
    int rows = 0;
    for (; !test_->ready() && row_ < log_.rows(); ++rows) advance();
    return rows;
  }

  const HypothesisTest& test() const { return *test_; }
  FaultLabel label(const EpisodeEvidence& evidence) const { return hypotheses_[evidence.best].label; }
  double time() const { return history_.back().time; }
  int trigger_row() const { return trigger_row_; }
  const FollowedSample& last() const { return history_.back(); }

  /// Log likelihood ratio now of a hypothesis followed from its start, nothing pruned.
  double ratio(int hypothesis, std::int64_t onset) const {
    RunningHypothesis running = bank_.start(hypothesis, onset, history_[onset - 1], history_[onset]);
    for (std::int64_t k = onset + 1; k <= history_.last(); ++k)
      bank_.advance(running, history_[k - 1], history_[k]);
    return running.log_likelihood_ratio;
  }
  double best_of_all() const {
    double best = -1e300;
    for (std::size_t h = 0; h < hypotheses_.size(); ++h)
      for (const int offset : kNearOffsets)
        best = std::max(best, ratio(static_cast<int>(h), trigger_row_ - offset));
    return best;
  }

 private:
  double take() {
    FollowedSample& sample = history_.push();
    follower_.follow(log_, row_++, sample);
    return trigger_.take(sample);
  }

  const Log log_;
  EvidenceOptions options_;
  MotionModel model_ = hand_made_model(known_rrp());
  Follower follower_{model_};
  Trigger trigger_{model_};
  std::vector<Hypothesis> hypotheses_ = hypotheses_of(3, TorqueMeaning::commanded);
  Bank bank_{model_, follower_.dynamics(), hypotheses_};
  History history_;
  std::optional<HypothesisTest> test_;
  int row_ = 0, trigger_row_ = 0;
};

Log healthy_log() { return simulate(known_rrp(), rrp_run(5.0), 77).log; }

Log faulty_log(FaultKind kind, int joint, double size = 0.0) {
  return simulate(known_rrp(), rrp_run_with(kind, joint, kOnset_s, size), 5).log;
}

struct Expected {
  FaultLabel label;
  double size;
  double onset_within_s;
};

void PrintTo(const Expected& expected, std::ostream* out) { *out << label_text(expected.label); }

class JudgedFault : public testing::TestWithParam<Expected> {};

TEST_P(JudgedFault, IsTheBestHypothesisAndBeganWhenItDid) {
  const Expected& expected = GetParam();
  Watch watch(faulty_log(expected.label.kind, expected.label.joint, expected.size));
  ASSERT_TRUE(watch.wake());
  EXPECT_GE(watch.time(), kOnset_s) << "the trigger is silent before the fault";
  watch.rows_until_ready();
  ASSERT_TRUE(watch.test().alarmed());
  EXPECT_EQ(watch.test().no_fault(), nullptr);
  const EpisodeEvidence evidence = watch.test().evidence();
  EXPECT_EQ(label_text(watch.label(evidence)), label_text(expected.label));
  EXPECT_NEAR(evidence.onset_s, kOnset_s, expected.onset_within_s);
  EXPECT_GE(evidence.alarm_s, kOnset_s);
  EXPECT_NEAR(evidence.isolated_s, watch.time(), 1e-12);
  const HypothesisEvidence& best = evidence.hypotheses[evidence.best];
  EXPECT_GE(best.log_likelihood_ratio, watch.test().best_ratio()) << "refining makes it no worse";
  EXPECT_NEAR(best.size[0], expected.size, 0.1 * std::abs(expected.size));
}

INSTANTIATE_TEST_SUITE_P(Rrp, JudgedFault,
                         testing::Values(Expected{{FaultKind::free_swinging, 3}, 0.0, 0.011},
                                         Expected{{FaultKind::locked, 2}, 0.0, 0.011},
                                         Expected{{FaultKind::torque_loss, 3}, 0.5, 0.021},
                                         Expected{{FaultKind::sensor_bias, 1}, 0.05, 0.011},
                                         Expected{{FaultKind::payload_change, 3}, 1.5, 0.021}));

TEST(HypothesisTest, AHealthyLogGivesNoAlarm) {
  Watch watch(healthy_log());
  EXPECT_FALSE(watch.wake()) << "nor a suspicion";
  Watch asked(healthy_log());
  ASSERT_TRUE(asked.wake(kMovingRow));
  asked.advance(60);
  EXPECT_FALSE(asked.test().alarmed()) << label_text(asked.label(asked.test().evidence()));
  EXPECT_LT(asked.test().largest_ratio(), 18.0);
}

TEST(HypothesisTest, ASuspicionWithoutAlarmIsOverAfterItsTimeAndSixteenSamples) {
  const auto rows = [](double confirm_s) {
    Watch watch(healthy_log(), {.confirm_s = confirm_s});
    EXPECT_TRUE(watch.wake(kMovingRow));
    return watch.rows_until_ready();
  };
  EXPECT_NEAR(rows(0.3), 30, 1);
  EXPECT_EQ(rows(0.05), 16);
}

/// Samples from the alarm until the fault is named.
int rows_to_name(const EvidenceOptions& options, std::int64_t capacity = 1024) {
  Watch watch(faulty_log(FaultKind::free_swinging, 3), options, capacity);
  EXPECT_TRUE(watch.wake());
  int before_alarm = 0;
  for (; !watch.test().alarmed(); ++before_alarm) watch.advance();
  return watch.rows_until_ready();
}

TEST(HypothesisTest, AClearFaultIsNamedAfterItsTimeAndSamples) {
  EXPECT_NEAR(rows_to_name({.isolate_s = 0.2, .clear_margin = -1.0}), 20, 1);
  EXPECT_EQ(rows_to_name({.isolate_s = 0.0, .clear_margin = -1.0, .fewest_samples = 11}), 11);
}

TEST(HypothesisTest, AnUnclearFaultIsNamedAfterTheLongestTime) {
  EXPECT_NEAR(rows_to_name({.isolate_s = 0.2, .longest_isolate_s = 0.5, .clear_margin = 1e9}), 50, 1);
}

TEST(HypothesisTest, AFaultIsNamedBeforeTheHistoryForgetsWhereItBegan) {
  const int rows = rows_to_name({.isolate_s = 5.0, .longest_isolate_s = 9.0}, 64);
  EXPECT_LE(rows, 33);
  EXPECT_GE(rows, 28);
}

/// Whether a freed joint raises the alarm, and as what, where healthy days imitate these faults by so much.
std::string named_where_imitated(bool the_true_one, bool the_others, double nats) {
  const FaultLabel truth{FaultKind::free_swinging, 3};
  EvidenceOptions options;
  for (const FaultLabel& label : labels_of(hypotheses_of(3, TorqueMeaning::commanded)).labels)
    if (label.kind != FaultKind::none && (label == truth ? the_true_one : the_others))
      options.imitations.push_back({label, nats});
  Watch watch(faulty_log(truth.kind, truth.joint), options);
  EXPECT_TRUE(watch.wake());
  watch.rows_until_ready();
  return watch.test().alarmed() ? label_text(watch.label(watch.test().evidence())) : "nothing";
}

TEST(HypothesisTest, AFaultThatHealthyDaysImitateHasToExplainThatMuchMore) {
  const std::string truth = label_text({FaultKind::free_swinging, 3});
  EXPECT_EQ(named_where_imitated(false, true, 1e6), truth);
  EXPECT_EQ(named_where_imitated(true, true, 5.0), truth);
  EXPECT_EQ(named_where_imitated(true, false, 1e6), truth)
      << "others raise the alarm, the likeliest is named";
  EXPECT_EQ(named_where_imitated(true, true, 1e6), "nothing");
}

TEST(HypothesisTest, ASingleWildRowIsMisread) {
  Log log = healthy_log();
  log.q[0][300] += 0.05;
  Watch watch(log);
  ASSERT_TRUE(watch.wake());
  EXPECT_EQ(watch.trigger_row(), 300);
  watch.advance(40);
  const RunningHypothesis* misread = watch.test().no_fault();
  ASSERT_NE(misread, nullptr);
  EXPECT_NEAR(misread->state.mean[0], log.q[0][340], 1e-3)
      << "the filter that passed over it is where the robot is";
}

TEST(HypothesisTest, TwoWildRowsOfTheSameKindAreNotMisread) {
  Log log = faulty_log(FaultKind::sensor_bias, 1, 0.05);
  Watch watch(log);
  ASSERT_TRUE(watch.wake());
  watch.advance(40);
  EXPECT_EQ(watch.test().no_fault(), nullptr);
}

TEST(HypothesisTest, PruningKeepsTheWinner) {
  Watch watch(faulty_log(FaultKind::locked, 2));
  ASSERT_TRUE(watch.wake());
  for (const int rows : {11, 2, 26, 2, 30}) {  // to 11, 13, 39, 41, 71: before and after both prunings
    watch.advance(rows);
    EXPECT_NEAR(watch.test().best_ratio(), watch.best_of_all(), 1e-6);
  }
}

TEST(HypothesisTest, LabelsFarBehindAreKeptAsADeficit) {
  Watch watch(faulty_log(FaultKind::free_swinging, 3));
  ASSERT_TRUE(watch.wake());
  watch.advance(60);
  const EpisodeEvidence evidence = watch.test().evidence();
  for (const HypothesisEvidence& h : evidence.hypotheses) {
    EXPECT_FALSE(std::isnan(h.log_likelihood_ratio));
    EXPECT_LE(h.log_likelihood_ratio, evidence.hypotheses[evidence.best].log_likelihood_ratio);
  }
  EXPECT_FALSE(evidence.trace.curves.empty());
}

TEST(HypothesisTest, NothingBeforeTheRestartIsTried) {
  const Log log = faulty_log(FaultKind::free_swinging, 3);
  const MotionModel model = hand_made_model(known_rrp());
  Follower follower(model);
  const std::vector<Hypothesis> hypotheses = hypotheses_of(3, TorqueMeaning::commanded);
  const Bank bank(model, follower.dynamics(), hypotheses);
  History history(1024);
  const int restart = static_cast<int>(kOnset_s / kPeriod_s) + 8;
  for (int row = 0; row <= restart + 2; ++row) follower.follow(log, row, history.push());
  const HypothesisTest late(bank, history, {}, restart, 0);
  const EpisodeEvidence evidence = late.evidence();
  for (const HypothesisEvidence& h : evidence.hypotheses)
    EXPECT_FALSE(h.onset_s < log.time[restart]) << "NaN where a hypothesis never fitted";
}

}  // namespace
}  // namespace faultline
