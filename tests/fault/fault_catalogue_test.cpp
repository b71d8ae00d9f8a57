// SPDX-License-Identifier: MIT
#include "lib/fault/fault_catalogue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace faultline {
namespace {

TEST(FaultCatalogue, NamesAreUniqueAndReadBack) {
  std::set<std::string> names;
  for (int k = 0; k < kFaultKinds; ++k) {
    const FaultKind kind = static_cast<FaultKind>(k);
    names.insert(to_string(kind));
    EXPECT_EQ(fault_kind_from(to_string(kind)), kind);
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kFaultKinds));
}

TEST(FaultCatalogue, EverySizeOfASimulatedKindCanBeDrawn) {
  for (int k = 0; k < static_cast<int>(FaultKind::unknown); ++k) {
    const FaultDescription& fault = describe(static_cast<FaultKind>(k));
    for (const FaultSize& size : fault.sizes()) {
      EXPECT_LT(size.twin.low, size.twin.high) << fault.name;
      EXPECT_GT(size.twin.low + (size.twin.spread == Spread::uniform), 0.0) << fault.name;
    }
    EXPECT_EQ(fault.passes, fault.twin_length_s.high > 0.0) << fault.name;
  }
}

TEST(FaultCatalogue, KindsThatTheMeasuredTorqueHidesActOnTheMotion) {
  for (int k = 0; k < kFaultKinds; ++k) {
    const FaultDescription& fault = describe(static_cast<FaultKind>(k));
    EXPECT_TRUE(!fault.hidden_by_measured_torque || fault.acts_on == FaultActsOn::motion) << fault.name;
    EXPECT_EQ(fault.place == FaultPlace::nowhere, fault.acts_on == FaultActsOn::nothing) << fault.name;
  }
}

std::string said(FaultKind kind, double first, double second, bool turns) {
  return size_text({kind, 2_joint}, {first, second}, turns);
}

TEST(SizeText, StatesSizesInTheUnitsOfTheJoint) {
  EXPECT_EQ(said(FaultKind::torque_loss, 0.417, 0.0, true), "about 42 % of the torque is lost");
  EXPECT_EQ(said(FaultKind::sensor_bias, 0.0123456, 0.0, true), "the position reads 0.01235 rad too much");
  EXPECT_EQ(said(FaultKind::sensor_bias, -0.5, 0.0, false), "the position reads 0.5 m too little");
  EXPECT_EQ(said(FaultKind::sensor_drift, -0.012345, 0.0, false), "the position drifts by -0.0123 m/s");
  EXPECT_EQ(said(FaultKind::friction_increase, 1.5, 2.25, true),
            "dry friction changed by +2.25 N m, viscous friction by +1.5 N m s/rad");
  EXPECT_EQ(said(FaultKind::friction_increase, 1.5, 2.25, false),
            "dry friction changed by +2.25 N, viscous friction by +1.5 N s/m");
  EXPECT_EQ(said(FaultKind::payload_change, 1.2, 0.0, false),
            "the load at the end of link 2 changed by +1.2 kg");
  EXPECT_EQ(said(FaultKind::collision, -0.25, 0.0, true), "the push had an impulse of -0.25 N m s");
}

TEST(SizeText, IsEmptyForKindsWithoutSize) {
  for (const FaultKind kind : {FaultKind::none, FaultKind::free_swinging, FaultKind::locked,
                               FaultKind::stuck_encoder, FaultKind::unknown})
    EXPECT_EQ(said(kind, 1.0, 2.0, true), "") << to_string(kind);
}

TEST(UnitOf, ATurningJointHasAnglesAndASlidingOneLengths) {
  EXPECT_STREQ(unit_of(SizeMeasure::viscous_friction, true), "N m s/rad");
  EXPECT_STREQ(unit_of(SizeMeasure::viscous_friction, false), "N s/m");
  EXPECT_STREQ(unit_of(SizeMeasure::mass, true), unit_of(SizeMeasure::mass, false));
}

TEST(FaultLabels, AreEachKindAtEachJointAndThePayloadOfTheLinksThatShowIt) {
  const auto labels = fault_labels(3, {1_joint, 3_joint}, false);
  EXPECT_EQ(labels.size(), 9u * 3u + 2u);
  const auto count = [&](FaultKind kind) {
    return std::count_if(labels.begin(), labels.end(), [&](const FaultLabel& l) { return l.kind == kind; });
  };
  EXPECT_EQ(count(FaultKind::locked), 3);
  EXPECT_EQ(count(FaultKind::payload_change), 2);
  EXPECT_TRUE(std::count(labels.begin(), labels.end(), FaultLabel{FaultKind::payload_change, 1_joint}) == 1 &&
              std::count(labels.begin(), labels.end(), FaultLabel{FaultKind::payload_change, 3_joint}) == 1);
  EXPECT_EQ(count(FaultKind::none) + count(FaultKind::unknown), 0);
}

TEST(FaultLabels, ATorqueMeasuredBehindTheDriveHidesItsLoss) {
  for (const FaultLabel& label : fault_labels(3, {3_joint}, true)) {
    EXPECT_NE(label.kind, FaultKind::torque_loss);
    EXPECT_NE(label.kind, FaultKind::free_swinging);
  }
}

}  // namespace
}  // namespace faultline
