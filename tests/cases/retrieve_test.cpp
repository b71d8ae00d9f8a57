// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/cases/votes.hpp"
#include "tests/cases/example_base.hpp"

namespace faultline {
namespace {

TEST(Retrieve, FindsTheCaseItselfFirst) {
  const CaseBase base = example_base();
  const auto found = retrieve(base, base.at(11).episode.features, 3);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].found->id, 11);
  EXPECT_DOUBLE_EQ(found[0].similarity, 1.0);
  EXPECT_GE(found[1].similarity, found[2].similarity);
  for (const Neighbour& n : found) EXPECT_EQ(n.found->label, base.at(11).label);
}

TEST(Retrieve, EqualSimilarityIsOrderedById) {
  CaseBase base({"a", "b", "noise"});
  Random random(1);
  const Case twin = example_case(random, kFree, 0, 0);
  for (int i = 0; i < 5; ++i) base.retain(twin);
  const auto found = retrieve(base, twin.episode.features, 4);
  ASSERT_EQ(found.size(), 4u);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(found[i].found->id, i + 1);
}

TEST(Retrieve, ReturnsAtMostTheExistingCases) {
  const CaseBase base = example_base(1);
  const std::vector<double> origin = {0, 0, 0};
  EXPECT_EQ(retrieve(base, origin, 10).size(), 3u);
  EXPECT_TRUE(retrieve(base, origin, 0).empty());
  EXPECT_TRUE(retrieve(CaseBase({"a", "b", "noise"}), origin, 10).empty());
}

}  // namespace
}  // namespace faultline
