// SPDX-License-Identifier: MIT
#include "lib/core/joint.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>
#include <type_traits>
#include <vector>

#include "lib/core/json/json_fields.hpp"

namespace faultline {
namespace {

static_assert(!std::is_convertible_v<int, Joint> && !std::is_convertible_v<Joint, int>);
static_assert(!std::is_constructible_v<Joint, int>);

TEST(Joint, IsNoneByDefault) {
  EXPECT_TRUE(Joint().is_none());
  EXPECT_EQ(Joint().number(), 0);
  EXPECT_EQ(Joint().index(), -1);
  EXPECT_EQ(Joint(), Joint::numbered(0));
  EXPECT_EQ(Joint(), 0_joint);
}

TEST(Joint, CountsFromZeroForVectorsAndFromOneForPeople) {
  EXPECT_FALSE(Joint::at(0).is_none());
  EXPECT_EQ(Joint::at(1).index(), 1);
  EXPECT_EQ(Joint::at(1).number(), 2);
  EXPECT_EQ(Joint::numbered(3).index(), 2);
  EXPECT_EQ(Joint::at(1), 2_joint);
}

TEST(Joint, OfANumberThatNoJointHasIsNoneAndKeepsTheNumber) {
  const Joint damaged = Joint::numbered(std::numeric_limits<int>::min());
  EXPECT_TRUE(damaged.is_none());
  EXPECT_EQ(damaged.index(), -1);
  EXPECT_NE(damaged, Joint());
  EXPECT_EQ(damaged.number(), std::numeric_limits<int>::min());
}

TEST(Joint, NoneIsBeforeTheFirst) {
  EXPECT_LT(Joint(), 1_joint);
  EXPECT_LT(1_joint, 2_joint);
  EXPECT_NE(1_joint, 2_joint);
}

TEST(Joint, PrintsItsNumber) {
  EXPECT_EQ(fmt::format("joint {}", Joint::at(1)), "joint 2");
  EXPECT_EQ(fmt::format("[{:>3}]", 2_joint), "[  2]");
  EXPECT_EQ(fmt::format("{}", Joint()), "0");
  EXPECT_EQ(fmt::format("{}", fmt::join(std::vector{1_joint, 3_joint}, ", ")), "1, 3");
}

struct Place {
  Joint joint, perhaps;
  std::vector<Joint> others;
};

void fields(auto& v, MaybeConst<Place> auto& place) {
  v("joint", place.joint);
  v.or_null("perhaps", place.perhaps);
  v("others", place.others);
}

TEST(Joint, IsItsNumberInJson) {
  const char* const text = R"({"joint":2,"others":[1,3],"perhaps":null})";
  const Place place{2_joint, Joint(), {1_joint, 3_joint}};
  const nlohmann::json json = fields_to_json<nlohmann::json>(place);
  EXPECT_EQ(json.dump(), text);
  const Place read = fields_from_json<Place>(json, "place.json");
  EXPECT_EQ(read.joint, place.joint);
  EXPECT_EQ(read.perhaps, Joint());
  EXPECT_EQ(read.others, place.others);
}

}  // namespace
}  // namespace faultline
