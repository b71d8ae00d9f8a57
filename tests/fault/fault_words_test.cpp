// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>

#include "lib/fault/fault_catalogue.hpp"

namespace faultline {
namespace {

TEST(FaultWords, EveryKindHasItsOwnWordsAndCheck) {
  std::set<std::string> names, checks;
  for (int kind = 0; kind < kFaultKinds; ++kind) {
    const FaultLabel label{static_cast<FaultKind>(kind), 3_joint};
    names.insert(describe(label.kind).heading);
    checks.insert(next_check_for(label));
    const char* place = label.kind == FaultKind::payload_change ? "link 3 " : "joint 3 ";
    EXPECT_EQ(plain_words(label).rfind(place, 0), 0u) << plain_words(label);
    EXPECT_EQ(next_check_for(label).find('{'), std::string::npos);
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kFaultKinds));
  EXPECT_EQ(checks.size(), static_cast<std::size_t>(kFaultKinds));
}

TEST(FaultWords, APayloadChangeNamesALinkAndEveryOtherFaultAJoint) {
  EXPECT_EQ(plain_words({FaultKind::payload_change, 2_joint}), "link 2 carries another load");
  EXPECT_EQ(plain_words({FaultKind::locked, 2_joint}), "joint 2 is locked");
}

}  // namespace
}  // namespace faultline
