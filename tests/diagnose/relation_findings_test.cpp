// SPDX-License-Identifier: MIT
#include "lib/diagnose/relation_findings.hpp"

#include <gtest/gtest.h>

#include "lib/diagnose/verdict.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {
namespace {

Model model() {
  Model out;
  out.robot = preset_robot("RR");
  return out;
}

RelationEpisode episode(RelationKind kind, Joint joint, double onset_s, double end_s) {
  RelationEpisode out;
  out.kind = kind;
  out.joint = joint;
  out.onset_s = onset_s;
  out.alarm_s = onset_s + 0.02;
  out.end_s = end_s;
  out.mean = 0.6;
  out.times_limit = 3.0;
  out.nats = 180.0;
  return out;
}

std::vector<FaultFinding> findings_of(const std::vector<RelationEpisode>& episodes) {
  std::vector<FaultFinding> out;
  for (const SignalStretch& stretch : stretches_of(episodes, TorqueMeaning::commanded))
    out.push_back(finding_of(episodes[stretch.id], judge_stretch(stretch, nullptr), 9.0, model()));
  return out;
}

const EvidenceItem* item(const FaultFinding& finding, const std::string& name) {
  for (const EvidenceItem& each : finding.evidence)
    if (each.name == name) return &each;
  return nullptr;
}

TEST(RelationFindings, AnEpisodeIsAStretchWithItsLimit) {
  RelationEpisode lasts = episode(RelationKind::control_law, 2_joint, 4.0, 9.0);
  lasts.lasts = true;
  const std::vector<SignalStretch> all =
      stretches_of({episode(RelationKind::actuator, 1_joint, 3.0, 3.2), lasts}, TorqueMeaning::measured);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].pair, SignalPair::drive);
  EXPECT_EQ(all[0].joint, 1_joint);
  EXPECT_EQ(all[0].end_s, 3.2);
  EXPECT_DOUBLE_EQ(all[0].limit, 20.0);
  EXPECT_FALSE(all[0].balance_is_of_command);
  EXPECT_EQ(all[1].pair, SignalPair::control_law);
  EXPECT_EQ(all[1].end_s, kNeverEnds);
  EXPECT_EQ(all[1].id, 1u);
}

TEST(RelationFindings, ALossStatesItsShareAndALawItsNextCheck) {
  RelationEpisode lost = episode(RelationKind::actuator, 1_joint, 3.0, 9.0);
  lost.share = 0.4;
  lost.share_explains = 0.9;
  const auto faults = findings_of({lost, episode(RelationKind::control_law, 2_joint, 4.0, 9.0)});
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[0].label, (FaultLabel{FaultKind::torque_loss, 1_joint}));
  EXPECT_DOUBLE_EQ(faults[0].extent.size, 0.4);
  ASSERT_NE(item(faults[0], "torque_share"), nullptr);
  EXPECT_DOUBLE_EQ(item(faults[0], "torque_share")->value, 40.0);
  EXPECT_EQ(faults[1].label, (FaultLabel{FaultKind::unknown, 2_joint}));
  EXPECT_EQ(faults[1].decided_by, DecidedBy::control_law);
  EXPECT_NE(faults[1].next_check.find("the controller of joint 2"), std::string::npos);
}

TEST(RelationFindings, TheEvidenceOfTheTorqueBalanceIsStated) {
  const RelationEpisode largest_mean = episode(RelationKind::actuator, 1_joint, 3.0, 3.2);
  JudgedStretch fault = judge_stretch(stretches_of({largest_mean}, TorqueMeaning::commanded)[0], nullptr);
  EXPECT_EQ(item(finding_of(largest_mean, fault, 9.0, model()), "motion"), nullptr);
  fault.in_balance = 75.0;
  const FaultFinding finding = finding_of(largest_mean, fault, 9.0, model());
  ASSERT_NE(item(finding, "motion"), nullptr);
  EXPECT_DOUBLE_EQ(item(finding, "motion")->value, 75.0);
  EXPECT_EQ(finding.decided_by, DecidedBy::actuator);
  EXPECT_EQ(finding.onset_s, 3.0);
  EXPECT_EQ(finding.end_s, 3.2);
}

TEST(RelationFindings, AShortDeviationOfAnotherDriveMeanwhileIsNotAFinding) {
  const auto faults = findings_of({episode(RelationKind::actuator, 1_joint, 4.0, 4.5),
                                   episode(RelationKind::actuator, 2_joint, 4.45, 4.5)});
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].label.joint, 1_joint);
}

TEST(RelationFindings, TwoDrivesThatDeviateAtTheSameTimeAreTwoFindings) {
  EXPECT_EQ(findings_of({episode(RelationKind::actuator, 1_joint, 4.0, 4.5),
                         episode(RelationKind::actuator, 2_joint, 4.1, 4.6)})
                .size(),
            2u);
}

TEST(RelationFindings, PulsesInQuickSuccessionStaySeparate) {
  auto faults = findings_of({episode(RelationKind::actuator, 1_joint, 3.0, 3.2),
                             episode(RelationKind::actuator, 1_joint, 3.6, 3.8)});
  EXPECT_EQ(merge_continued(std::move(faults)).size(), 2u);
}

}  // namespace
}  // namespace faultline
