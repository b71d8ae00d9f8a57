// SPDX-License-Identifier: MIT
#include "lib/learn/tracking_model.hpp"

#include <gtest/gtest.h>

#include "lib/core/error.hpp"
#include "lib/diagnose/diagnose.hpp"
#include "lib/learn/learn.hpp"
#include "lib/log/log_source.hpp"
#include "lib/report/text.hpp"
#include "lib/robot/robot_file.hpp"
#include "tests/residual/relation/stepped_joint.hpp"

namespace faultline {
namespace {

Robot one_joint() { return robot_from_toml("name = \"stepper\"\naxes = \"R\"\n", "robot"); }

const Learned& learned() {
  static const Learned result = [] {
    std::vector<MemorySource> days;
    for (const std::uint64_t seed : {1, 2, 3}) days.emplace_back(SteppedJoint{.seed = seed}.log(30.0));
    std::vector<LogSource*> pointers;
    for (MemorySource& day : days) pointers.push_back(&day);
    return learn(pointers, {}, one_joint());
  }();
  return result;
}

Diagnosis diagnosed(const Log& log, const Model& model = learned().model) {
  MemorySource source(log);
  return diagnose(source, model, {});
}

TEST(TrackingModel, LogsWithoutTorqueGiveAModelThatIsReadBack) {
  EXPECT_FALSE(learned().model.has_mechanics());
  const Model model = model_from_json(model_to_json(learned().model), "model");
  EXPECT_EQ(model_to_json(model), model_to_json(learned().model));
  const Log stall = SteppedJoint{.stall_from_s = 9.0, .stall_to_s = 10.0, .seed = 5}.log(20.0);
  EXPECT_EQ(render_text(diagnosed(stall, model)).find("inconclusive"), std::string::npos);
}

TEST(TrackingModel, AHealthyLogIsHealthyAndTheReportStatesItsBlindSpots) {
  const Diagnosis diagnosis = diagnosed(SteppedJoint{.seed = 4}.log(30.0));
  EXPECT_EQ(diagnosis.verdict, Verdict::healthy);
  EXPECT_EQ(diagnosis.verdict_reason, "every joint that is judged follows its reference");
  ASSERT_GE(diagnosis.cannot_see.size(), 2u);
  EXPECT_NE(diagnosis.cannot_see[0].find("Without torque"), std::string::npos);
  EXPECT_NE(diagnosis.cannot_see[1].find("errors below"), std::string::npos);
}

TEST(TrackingModel, AStallIsOneLockedJoint) {
  const Diagnosis diagnosis =
      diagnosed(SteppedJoint{.stall_from_s = 9.0, .stall_to_s = 10.0, .seed = 5}.log(20.0));
  ASSERT_EQ(diagnosis.faults.size(), 1u);
  const FaultFinding& fault = diagnosis.faults[0];
  EXPECT_EQ(fault.label, (FaultLabel{FaultKind::locked, 1_joint}));
  EXPECT_EQ(fault.decided_by, DecidedBy::tracking);
  EXPECT_NEAR(fault.onset_s, 9.0, 0.15);
  EXPECT_LT(fault.end_s, 12.5);
}

TEST(TrackingModel, LostStepsAreAFaultThatLastsToTheEnd) {
  const Diagnosis diagnosis = diagnosed(
      SteppedJoint{.stall_from_s = 9.0, .stall_to_s = 9.3, .counts_steps = true, .seed = 6}.log(20.0));
  ASSERT_EQ(diagnosis.faults.size(), 1u);
  EXPECT_GT(diagnosis.faults[0].end_s, 19.9);
}

TEST(TrackingModel, ALogWithoutItsReferencesIsRefusedWithTheReason) {
  Log log = SteppedJoint{.seed = 4}.log(20.0);
  log.q_ref.clear(), log.dq_ref.clear();
  try {
    diagnosed(log);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    EXPECT_NE(std::string(error.what()).find("q_ref1"), std::string::npos);
  }
}

TEST(TrackingModel, AReferenceThatNeverChangesWhileTheJointMovesLeavesTheLogInconclusive) {
  Log log = SteppedJoint{.seed = 4}.log(20.0);
  for (JointSignals* signals : {&log.q_ref, &log.dq_ref})
    std::fill((*signals)[0].begin(), (*signals)[0].end(), 0.0);
  const Diagnosis diagnosis = diagnosed(log);
  EXPECT_EQ(diagnosis.verdict, Verdict::inconclusive);
  EXPECT_TRUE(diagnosis.faults.empty());
}

TEST(TrackingModel, AJointThatStandsForTheWholeLogWhileItsReferenceMovesIsLocked) {
  Log log = SteppedJoint{.seed = 4}.log(20.0);
  std::fill(log.q[0].begin(), log.q[0].end(), 0.25);
  std::fill(log.dq[0].begin(), log.dq[0].end(), 0.0);
  const Diagnosis diagnosis = diagnosed(log);
  EXPECT_EQ(diagnosis.verdict, Verdict::faulty);
  ASSERT_FALSE(diagnosis.faults.empty());
  EXPECT_EQ(diagnosis.faults[0].label, (FaultLabel{FaultKind::locked, 1_joint}));
  EXPECT_LT(diagnosis.faults[0].alarm_s, 2.0);
}

TEST(TrackingModel, AParkedJointIsHealthyAndAnEmptyReferenceIsNot) {
  Log log = SteppedJoint{.seed = 4}.log(20.0);
  std::fill(log.q[0].begin(), log.q[0].end(), 0.25),
      std::fill(log.q_ref[0].begin(), log.q_ref[0].end(), 0.25);
  std::fill(log.dq[0].begin(), log.dq[0].end(), 0.0),
      std::fill(log.dq_ref[0].begin(), log.dq_ref[0].end(), 0.0);
  EXPECT_EQ(diagnosed(log).verdict, Verdict::healthy);
  const double none = std::nan("");
  std::fill(log.q_ref[0].begin(), log.q_ref[0].end(), none);
  std::fill(log.dq_ref[0].begin(), log.dq_ref[0].end(), none);
  EXPECT_EQ(diagnosed(log).verdict, Verdict::inconclusive);
}

}  // namespace
}  // namespace faultline
