// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/dual_decision.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace faultline {
namespace {

const std::vector<FaultLabel> kClasses = {
    {FaultKind::free_swinging, 1_joint}, {FaultKind::free_swinging, 2_joint}, {}};

NetworkSum sum_of(double first, double second) {
  NetworkSum sum;
  sum.sum = Eigen::Vector2d(first, second);
  sum.output = first >= second ? 0 : 1;
  sum.best = std::max(first, second);
  sum.last = 1.0;
  return sum;
}

SuspectSample suspicion(double time_s, int samples, const NetworkSum& mlp, const NetworkSum& rbfn) {
  return {time_s, samples, mlp, rbfn};
}

/// On record: the MLP alone was wrong, the RBFN alone was right.
CaseBase cases() {
  CaseBase base(suspect_feature_names(2));
  auto retain = [&](const SuspectSample& s, const FaultLabel& label) {
    Case c;
    c.episode = episode_of(s, kClasses, 5.0);
    c.decision = c.label = label;
    c.outcome = CaseOutcome::confirmed;
    base.retain(c);
  };
  for (int i = 0; i < 10; ++i) {
    const double more = 0.1 * i;
    retain(suspicion(0.0, 2, sum_of(6.0 + more, 0.0), sum_of(0.0, 0.0)), {});
    retain(suspicion(0.0, 2, sum_of(0.0, 0.0), sum_of(0.0, 6.0 + more)), kClasses[1]);
  }
  base.learn();
  return base;
}

TEST(DualDecision, AcceptsNetworksThatAgreeAndLetsCasesDecideTheRest) {
  const double dt = kSamplePeriod;
  const std::vector<SuspectSample> suspicions = {
      suspicion(1.0, 2, sum_of(6.2, 0.0), sum_of(0.0, 0.0)),       // a false alarm, say the cases
      suspicion(5.0, 2, sum_of(0.0, 0.0), sum_of(0.0, 6.2)),       // joint 2, say the cases
      suspicion(5.0 + dt, 3, sum_of(0.0, 7.0), sum_of(0.0, 9.0)),  // goes on
      suspicion(9.0, 2, sum_of(7.0, 0.0), sum_of(8.0, 0.0)),       // both say joint 1
      suspicion(12.0, 2, sum_of(4.0, 0.0), sum_of(4.0, 0.0)),      // below the threshold
  };
  const double thresholds[] = {5.0};
  const Alarms alarms = decide_suspects(suspicions, kClasses, cases(), thresholds)[0];
  ASSERT_EQ(alarms.size(), 2u);
  EXPECT_EQ(alarms[0].time_s, 5.0);
  EXPECT_EQ(alarms[0].label, kClasses[1]);
  EXPECT_EQ(alarms[1].time_s, 9.0);
  EXPECT_EQ(alarms[1].label, kClasses[0]);
}

TEST(DualDecision, TakesTheClassThatBothNetworksNameAtEachSample) {
  SampleOutputs outputs;
  outputs.time = Eigen::Vector2d(0.0, 1.0);
  outputs.mlp = Eigen::MatrixXd{{0.1, 0.8}, {0.2, 0.1}, {0.7, 0.1}};
  outputs.rbfn = Eigen::MatrixXd{{0.0, 0.9}, {0.0, 0.0}, {1.0, 0.1}};
  const CaseBase none({"mlp_1", "mlp_2", "mlp_3", "rbfn_1", "rbfn_2", "rbfn_3"});
  const Eigen::MatrixXd decided = decide_samples(outputs, kClasses, none);
  EXPECT_EQ(decided, (Eigen::MatrixXd{{0.0, 1.0}, {0.0, 0.0}, {1.0, 0.0}}));
}

TEST(DualDecision, GivesNoDecisionForASampleWithoutOutputs) {
  SampleOutputs outputs;
  outputs.time = Eigen::Vector2d(0.0, kSamplePeriod);
  outputs.mlp = outputs.rbfn = Eigen::MatrixXd::Zero(3, 2);
  outputs.mlp(1, 0) = outputs.rbfn(1, 0) = 1.0;
  outputs.rbfn(0, 1) = std::numeric_limits<double>::quiet_NaN();
  const Eigen::MatrixXd decided = decide_samples(outputs, kClasses, CaseBase({"a", "b", "c", "d", "e", "f"}));
  EXPECT_EQ(decided(1, 0), 1.0);
  EXPECT_TRUE(decided.col(1).array().isNaN().all());
}

}  // namespace
}  // namespace faultline
