// SPDX-License-Identifier: MIT
#include "lib/fault/fault_labels.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace faultline {
namespace {

TEST(FaultLabels, AreEachKindAtEachJointAndThePayloadOfTheLinksWhereItShows) {
  const auto labels = fault_labels(3, {0, 2}, false);
  EXPECT_EQ(labels.size(), 9u * 3u + 2u);
  const auto count = [&](FaultKind kind) {
    return std::count_if(labels.begin(), labels.end(), [&](const FaultLabel& l) { return l.kind == kind; });
  };
  EXPECT_EQ(count(FaultKind::locked), 3);
  EXPECT_EQ(count(FaultKind::payload_change), 2);
  EXPECT_TRUE(std::count(labels.begin(), labels.end(), FaultLabel{FaultKind::payload_change, 1}) == 1 &&
              std::count(labels.begin(), labels.end(), FaultLabel{FaultKind::payload_change, 3}) == 1);
  EXPECT_EQ(count(FaultKind::none) + count(FaultKind::unknown), 0);
}

TEST(FaultLabels, ATorqueMeasuredBehindTheDriveHidesItsLoss) {
  for (const FaultLabel& label : fault_labels(3, {2}, true)) {
    EXPECT_NE(label.kind, FaultKind::torque_loss);
    EXPECT_NE(label.kind, FaultKind::free_swinging);
  }
}

}  // namespace
}  // namespace faultline
