// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>

#include "lib/fault/fault_catalogue.hpp"

namespace faultline {
namespace {

TEST(FaultWords, EveryKindHasItsOwnWordsCheckAndExplanation) {
  std::set<std::string> names, checks, explanations;
  for (int kind = 0; kind < kFaultKinds; ++kind) {
    const FaultLabel label{static_cast<FaultKind>(kind), 3_joint};
    names.insert(describe(label.kind).heading);
    checks.insert(next_check_for(label));
    explanations.insert(describe(label.kind).learn_more);
    const char* place = label.kind == FaultKind::payload_change ? "link 3" : "joint 3";
    for (const std::string& words : {plain_words(label), next_check_for(label)})
      EXPECT_EQ(words.find('{'), std::string::npos) << words;
    EXPECT_NE(plain_words(label).find(place), std::string::npos) << plain_words(label);
  }
  for (const auto* all : {&names, &checks, &explanations})
    EXPECT_EQ(all->size(), static_cast<std::size_t>(kFaultKinds));
}

TEST(FaultWords, AFaultIsSaidInTheWordsOfATechnician) {
  EXPECT_EQ(plain_words({FaultKind::payload_change, 2_joint}), "link 2 carries another load");
  EXPECT_EQ(plain_words({FaultKind::locked, 2_joint}), "joint 2 is locked");
  EXPECT_EQ(plain_words({FaultKind::stuck_encoder, 3_joint}), "the encoder of joint 3 repeats one reading");
  EXPECT_EQ(plain_words({FaultKind::unknown}), "unknown fault");
}

}  // namespace
}  // namespace faultline
