// SPDX-License-Identifier: MIT
#include "lib/classify/fault_criterion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "lib/core/random.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

const OutputMeaning kMeaning{.classes = {{FaultKind::free_swinging, 1_joint},
                                         {FaultKind::free_swinging, 2_joint},
                                         {FaultKind::none, Joint()}},
                             .prior = {}};

/// A letter a sample: 'a', 'b' the faults, '.' none, '?' missing. 0.1 s apart, first at 0.
LabelledOutputs outputs_of(const std::string& said) {
  LabelledOutputs run;
  run.time = VectorXd::LinSpaced(static_cast<Eigen::Index>(said.size()), 0.0,
                                 0.1 * static_cast<double>(said.size() - 1));
  run.outputs = MatrixXd::Constant(3, static_cast<Eigen::Index>(said.size()), 0.1);
  for (std::size_t i = 0; i < said.size(); ++i) {
    if (said[i] == '?')
      run.outputs.col(i).setConstant(std::numeric_limits<double>::quiet_NaN());
    else
      run.outputs(said[i] == 'a' ? 0 : said[i] == 'b' ? 1 : 2, i) = 0.8;
  }
  return run;
}

std::vector<SampleEpisode> episodes(const CriterionOptions& options, const LabelledOutputs& run,
                                    int segment = 1000) {
  CriterionState state;
  std::vector<SampleEpisode> all;
  for (Eigen::Index at = 0; at < run.time.size(); at += segment) {
    const Eigen::Index count = std::min<Eigen::Index>(segment, run.time.size() - at);
    const auto ended = apply_criterion(options, kMeaning, run.time.segment(at, count),
                                       run.outputs.middleCols(at, count), state);
    all.insert(all.end(), ended.begin(), ended.end());
  }
  if (const auto open = open_episode(kMeaning, state)) all.push_back(*open);
  return all;
}

const CriterionOptions kThreeInARow{.kind = CriterionKind::consecutive, .g = 3};
const CriterionOptions kOdds{.kind = CriterionKind::log_odds, .threshold = 5.0};

TEST(Criterion, ThreeEqualSamplesInARowMakeAnAlarm) {
  EXPECT_TRUE(episodes(kThreeInARow, outputs_of("..aa.aa.bb..aabb..")).empty());
  const auto found = episodes(kThreeInARow, outputs_of("...bbbbb......"));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].label, (FaultLabel{FaultKind::free_swinging, 2_joint}));
  EXPECT_NEAR(found[0].onset_s, 0.3, 1e-12);
  EXPECT_NEAR(found[0].alarm_s, 0.5, 1e-12);
  EXPECT_NEAR(found[0].end_s, 0.7, 1e-12);
  EXPECT_DOUBLE_EQ(found[0].confidence, 1.0);
  EXPECT_FALSE(found[0].open);
}

TEST(Criterion, MissingSamplesBreakARunButNotASum) {
  EXPECT_TRUE(episodes(kThreeInARow, outputs_of("..aa?a..")).empty());
  const auto found = episodes(kOdds, outputs_of("..aa?a"));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].alarm_s, 0.5, 1e-12);
}

TEST(Criterion, OddsAccumulateOverInterruptions) {
  const auto found = episodes(kOdds, outputs_of("....aa.aaa.aaa.........."));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].label, (FaultLabel{FaultKind::free_swinging, 1_joint}));
  EXPECT_NEAR(found[0].onset_s, 0.4, 1e-12);
  EXPECT_NEAR(found[0].end_s, 1.3, 1e-12);
  EXPECT_FALSE(found[0].open);
}

TEST(Criterion, AnEpisodeThatIsOpenAtTheEndIsReported) {
  for (const auto& options : {kThreeInARow, kOdds}) {
    const auto found = episodes(options, outputs_of("...aaaaaa"));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_TRUE(found[0].open);
    EXPECT_NEAR(found[0].end_s, 0.8, 1e-12);
  }
}

TEST(Criterion, TheLabelIsTheMajorityAndConfidenceItsShare) {
  const auto found = episodes(kThreeInARow, outputs_of("..aaabbbbbbb...."));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].label.joint, 2_joint);
  EXPECT_DOUBLE_EQ(found[0].confidence, 0.7);
}

TEST(Criterion, SegmentBordersChangeNothing) {
  const LabelledOutputs run = outputs_of("..aa.aaa??aaa....bbb.bbbb......aaaaaa");
  for (const auto& options : {kThreeInARow, kOdds}) {
    const auto whole = episodes(options, run);
    ASSERT_GE(whole.size(), 2u);
    for (int segment : {1, 7}) {
      const auto parts = episodes(options, run, segment);
      ASSERT_EQ(parts.size(), whole.size());
      for (std::size_t i = 0; i < whole.size(); ++i) {
        EXPECT_EQ(parts[i].label, whole[i].label);
        EXPECT_EQ(parts[i].onset_s, whole[i].onset_s);
        EXPECT_EQ(parts[i].alarm_s, whole[i].alarm_s);
        EXPECT_EQ(parts[i].end_s, whole[i].end_s);
        EXPECT_EQ(parts[i].confidence, whole[i].confidence);
      }
    }
  }
}

TEST(Criterion, ThePriorOfTrainingIsDividedOut) {
  OutputMeaning rare =
      kMeaning;  // where the fault was 40 times likelier than none, 0.8 against 0.1 speaks for none
  rare.prior = VectorXd(3);
  rare.prior << 0.8, 0.18, 0.02;
  CriterionState state;
  const LabelledOutputs run = outputs_of("aaaaaaaaaaaaaaaaaaaa");
  apply_criterion(kOdds, rare, run.time, run.outputs, state);
  EXPECT_FALSE(open_episode(rare, state).has_value());
}

/// Fault-free samples err now and then, two at a time at most; faults are seen in most samples.
LabelledOutputs noisy_run(std::uint64_t seed, bool faulty) {
  Random random(seed);
  std::string said;
  for (int i = 0; i < 400; ++i) {
    const bool fault = faulty && i >= 200;
    said += random.uniform() < (fault ? 0.9 : 0.06) ? 'a' : '.';
  }
  LabelledOutputs run = outputs_of(said);
  if (faulty) {
    run.fault = {FaultKind::free_swinging, 1_joint};
    run.onset_s = 20.0 - 1e-9;
  }
  return run;
}

TEST(Criterion, TheSearchTradesFalseAlarmsForDelay) {
  std::vector<LabelledOutputs> runs;
  for (int i = 0; i < 20; ++i) runs.push_back(noisy_run(i, i % 2 == 0));
  for (const auto& start : {kThreeInARow, kOdds}) {
    const CriterionSearch search = tune_criterion(start, kMeaning, runs);
    EXPECT_GT(search.tried.front().false_alarms, 10);
    const CriterionScore best = score_criterion(search.best, kMeaning, runs);
    EXPECT_EQ(best.false_alarms, 0);
    EXPECT_EQ(best.detected, 10);
    EXPECT_EQ(best.right, 10);
    EXPECT_LT(best.median_delay_s, 2.0);
    for (std::size_t i = 1; i < search.tried.size(); ++i)
      EXPECT_LE(search.tried[i].false_alarms, search.tried[i - 1].false_alarms);
  }
}

}  // namespace
}  // namespace faultline
