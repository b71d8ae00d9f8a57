// SPDX-License-Identifier: MIT
#include "lib/cases/possible_labels.hpp"

#include <gtest/gtest.h>

#include "lib/core/error.hpp"
#include "tests/cases/example_base.hpp"

namespace faultline {
namespace {

std::string refusal(const CaseBase& base, const FaultLabel& label) {
  try {
    check_label(base, label, "--fault");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    return error.message();
  }
  return "";
}

CaseBase base_of_bank() {
  CaseBase base(
      {"behind locked 1", "behind locked 2", "behind payload_change 2", "mlp residual 1", "mlp residual 2"});
  base.describe_robot({"bench", "RR"});
  return base;
}

TEST(PossibleLabels, TheNumberOfJointsFollowsFromTheAxes) {
  EXPECT_EQ(joints_of(base_of_bank()), 2);
  CaseBase base({"a"});
  base.describe_robot({"bench", "RRPR"});
  EXPECT_EQ(joints_of(base), 4);
}

TEST(PossibleLabels, AModelWithoutHypothesesExcludesNoFaultOfAJointThatIsThere) {
  CaseBase base;
  base.describe_robot({"slide", "P"});
  EXPECT_EQ(refusal(base, {FaultKind::locked, 1_joint}), "");
  EXPECT_NE(refusal(base, {FaultKind::locked, 2_joint}).find("has 1 joint"), std::string::npos);
}

TEST(PossibleLabels, AJointThatTheRobotLacksIsRefused) {
  EXPECT_EQ(refusal(base_of_bank(), {FaultKind::locked, 2_joint}), "");
  EXPECT_NE(refusal(base_of_bank(), {FaultKind::locked, 3_joint}).find("has 2 joints"), std::string::npos);
}

TEST(PossibleLabels, AJointIsRequiredOnlyIfTheFaultHasOne) {
  EXPECT_NE(refusal(base_of_bank(), {FaultKind::locked, Joint()}).find("give its number"), std::string::npos);
  EXPECT_NE(refusal(base_of_bank(), {FaultKind::none, 1_joint}).find("no joint"), std::string::npos);
  EXPECT_EQ(refusal(base_of_bank(), {FaultKind::payload_change, 2_joint}), "");
  EXPECT_NE(refusal(base_of_bank(), {FaultKind::payload_change, 1_joint}).find("can find"), std::string::npos)
      << "the model of this case base knows no mass on link 1";
  EXPECT_EQ(refusal(base_of_bank(), {FaultKind::none, Joint()}), "");
  EXPECT_EQ(refusal(base_of_bank(), {FaultKind::unknown, Joint()}), "");
  EXPECT_EQ(with_tip({FaultKind::payload_change, Joint()}, 2).joint, 2_joint);
  EXPECT_EQ(with_tip({FaultKind::locked, Joint()}, 2).joint, Joint());
}

TEST(PossibleLabels, AKindWithoutHypothesisIsRefusedUnlessACaseHasIt) {
  CaseBase base = base_of_bank();
  const FaultLabel label{FaultKind::torque_sensor_error, 1_joint};
  EXPECT_NE(refusal(base, label).find("torque_sensor_error 1"), std::string::npos);
  Case c;
  c.episode.features.resize(5);
  c.label = c.decision = label;
  base.retain(c);
  EXPECT_EQ(refusal(base, label), "");
}

}  // namespace
}  // namespace faultline
