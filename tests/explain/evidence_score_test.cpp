// SPDX-License-Identifier: MIT
// The score of a log: how near it comes to an alarm, of a robot in closed form.
#include "lib/explain/evidence_score.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "lib/explain/explain_faults.hpp"
#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

EvidenceScore scored_log(Log log) {
  return explain_faults(testing::on_grid(std::move(log)), testing::scara_model(), evidence_limits({})).score;
}

/// A log whose torque of joint 1 has an offset from 3.5 s on, N m.
Log with_offset(double offset) {
  return testing::changed(testing::simulate_closed_form(testing::of_day(2), testing::run_of(21)), 3.5,
                          kNeverEnds, [=](Log& log, int k) { log.tau[0][k] += offset; });
}

FaultHypothesis hypothesis_with(FaultKind kind, Joint joint, double gain, double size) {
  FaultHypothesis out{{.kind = kind, .joint = joint, .size = Eigen::VectorXd::Constant(1, size)}};
  out.gain = gain;
  return out;
}

TEST(EvidenceScore, TheLargerRatioCountsAndNotTheLargerEvidence) {
  const EvidenceScore strong{{FaultKind::locked, 1_joint}, 1.0, 300.0, 1000.0};
  const EvidenceScore near{{FaultKind::collision, 2_joint}, 2.0, 90.0, 100.0};
  EXPECT_EQ(larger(strong, near).label, near.label);
  EXPECT_EQ(larger(near, strong).label, near.label);
  EXPECT_DOUBLE_EQ(near.ratio(), 0.9);
}

TEST(EvidenceScore, AKnownScoreReplacesOneThatIsNotKnown) {
  const EvidenceScore known{{FaultKind::locked, 1_joint}, 1.0, 0.0, 100.0};
  EXPECT_FALSE(EvidenceScore{}.is_known());
  EXPECT_EQ(larger(EvidenceScore{}, known).label, known.label);
  EXPECT_EQ(larger(known, EvidenceScore{}).label, known.label);
}

TEST(EvidenceScore, ATorqueLossTooSmallToBeAFaultDoesNotCount) {
  LogExplanation e;
  e.best = {hypothesis_with(FaultKind::torque_loss, 1_joint, 900.0, 0.5 * kLeastLoss),
            hypothesis_with(FaultKind::friction_increase, 2_joint, 50.0, 1.0)};
  const EvidenceScore score = score_of(e, evidence_limits({}));
  EXPECT_EQ(score.label, (FaultLabel{FaultKind::friction_increase, 2_joint}));
  EXPECT_DOUBLE_EQ(score.evidence, 50.0);
  EXPECT_DOUBLE_EQ(score.ratio(), 50.0 / kLeastEvidence);
}

TEST(EvidenceScore, NoFaultThatExplainsTheLogBetterGivesARatioOfZero) {
  LogExplanation e;
  e.quiet = {hypothesis_with(FaultKind::collision, 1_joint, -7.0, 1.0)};
  EXPECT_EQ(score_of(e, evidence_limits({})).ratio(), 0.0);
}

TEST(EvidenceScore, HealthyDaysAreBelowOneAndKnown) {
  for (const std::uint64_t seed : {21, 22, 23}) {
    const EvidenceScore score = scored_log(
        testing::simulate_closed_form(testing::of_day(static_cast<int>(seed)), testing::run_of(seed)));
    EXPECT_TRUE(score.is_known());
    EXPECT_LT(score.ratio(), 1.0) << label_text(score.label);
    EXPECT_GE(score.ratio(), 0.0);
  }
}

TEST(EvidenceScore, ItGrowsWithTheSizeOfTheFaultFromBelowOneToAboveOne) {
  std::vector<double> ratios;
  for (const double offset : {0.0, 0.05, 0.2, 0.8, 3.2})
    ratios.push_back(scored_log(with_offset(offset)).ratio());
  for (std::size_t k = 1; k < ratios.size(); ++k) EXPECT_GE(ratios[k], ratios[k - 1]) << k;
  EXPECT_LT(ratios.front(), 1.0);
  EXPECT_GT(ratios[3], ratios[2]);
  EXPECT_GT(ratios.back(), ratios[3]);
  EXPECT_GT(ratios.back(), 1.0);
}

TEST(EvidenceScore, AFaultIsFoundJustWhereTheRatioIsAboveOne) {
  for (const double offset : {0.0, 0.05, 0.2, 0.8, 3.2}) {
    const ExplainedLog explained =
        explain_faults(testing::on_grid(with_offset(offset)), testing::scara_model(), evidence_limits({}));
    EXPECT_EQ(explained.faults.empty(), explained.score.ratio() <= 1.0) << offset;
    for (const ExplainedFault& fault : explained.faults)
      EXPECT_GE(explained.score.ratio(), fault.evidence / fault.limit);
  }
}

}  // namespace
}  // namespace faultline
