// SPDX-License-Identifier: MIT
#include "lib/core/json_values.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(JsonValues, NumbersThatAreNotFiniteAreNull) {
  EXPECT_EQ(number_or_null(0.1).dump(), "0.1");
  EXPECT_TRUE(number_or_null(std::nan("")).is_null());
  EXPECT_TRUE(number_or_null(-kInfinity).is_null());
  EXPECT_EQ(numbers_or_null({1.0, kInfinity, -2.5}).dump(), "[1.0,null,-2.5]");
  EXPECT_EQ(numbers_or_null({}).dump(), "[]");
}

TEST(JsonValues, AnEmptyTextAndACountOfZeroAreNull) {
  EXPECT_EQ(text_or_null("a").dump(), "\"a\"");
  EXPECT_TRUE(text_or_null("").is_null());
  EXPECT_EQ(count_or_null(2).dump(), "2");
  EXPECT_TRUE(count_or_null(0).is_null());
}

TEST(JsonValues, AreReadBackFromPlainAndOrderedJson) {
  EXPECT_EQ(number_or_nan(number_or_null(0.1)), 0.1);
  EXPECT_TRUE(std::isnan(number_or_nan(nlohmann::json(nullptr))));
  EXPECT_TRUE(std::isnan(number_or_nan(nlohmann::ordered_json(nullptr))));
  EXPECT_EQ(text_or_empty(text_or_null("")), "");
  EXPECT_EQ(text_or_empty(text_or_null("a")), "a");
  EXPECT_EQ(count_or_zero(count_or_null(0)), 0);
  EXPECT_EQ(count_or_zero(count_or_null(3)), 3);
}

TEST(JsonValues, AValueOfTheWrongTypeIsRefused) {
  EXPECT_THROW(number_or_nan(nlohmann::json("1")), nlohmann::json::exception);
  EXPECT_THROW(text_or_empty(nlohmann::ordered_json(1)), nlohmann::json::exception);
}

TEST(JsonValues, AListRendersItsItemsInOrder) {
  const auto doubled = [](int i) { return nlohmann::json(2 * i); };
  EXPECT_EQ(list_of<nlohmann::json>(std::vector<int>{3, 1}, doubled).dump(), "[6,2]");
  EXPECT_EQ(list_of<nlohmann::ordered_json>(std::vector<int>{}, doubled).dump(), "[]");
}

TEST(JsonDepth, MoreThan64NestedListsAreRefused) {
  EXPECT_THROW(refuse_deep_json(std::string(65, '['), "x.json"), Error);
  EXPECT_THROW(refuse_deep_json("{\"a\": " + std::string(64, '{'), "x.json"), Error);
  EXPECT_NO_THROW(refuse_deep_json(std::string(64, '[') + std::string(64, ']'), "x.json"));
}

TEST(JsonDepth, BracketsInTextsAndListsInSuccessionAreNotDeep) {
  EXPECT_NO_THROW(
      refuse_deep_json("[\"" + std::string(100, '[') + "\\\"" + std::string(100, '{') + "\"]", "x"));
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "[{}],";
  EXPECT_NO_THROW(refuse_deep_json("[" + many + "[]]", "x.json"));
}

const nlohmann::json kObject = {{"number", 0.1}, {"text", "a"}, {"flag", true}, {"count", 3}, {"list", {1}}};

/// What the Error says that `read` throws.
template <typename Read>
std::string refusal(Read read) {
  try {
    read();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    EXPECT_EQ(error.where(), "file");
    return error.message();
  }
  return "nothing was thrown";
}

TEST(JsonMembers, AreReadByTheirType) {
  EXPECT_EQ(number_from_json(kObject, "number", "file"), 0.1);
  EXPECT_EQ(text_from_json(kObject, "text", "file"), "a");
  EXPECT_TRUE(flag_from_json(kObject, "flag", "file"));
  EXPECT_EQ(count_from_json(kObject, "count", "file"), 3);
  EXPECT_EQ(checked_list(member_of(kObject, "list", "file"), "list", "file").size(), 1u);
}

TEST(JsonMembers, AMissingMemberIsNamed) {
  EXPECT_EQ(refusal([] { member_of(kObject, "other", "file"); }), "key \"other\" is missing");
  EXPECT_EQ(refusal([] { member_of(nlohmann::json(1), "other", "file"); }), "key \"other\" is missing");
}

TEST(JsonMembers, AValueOfTheWrongTypeIsRefused) {
  EXPECT_EQ(refusal([] { number_from_json(kObject, "text", "file"); }),
            "text: expected a finite number, found \"a\"");
  EXPECT_EQ(refusal([] { text_from_json(kObject, "number", "file"); }), "number: expected a text");
  EXPECT_EQ(refusal([] { flag_from_json(kObject, "number", "file"); }), "number: expected true or false");
  EXPECT_EQ(refusal([] { checked_list(kObject, "all", "file"); }), "all: expected a list");
}

TEST(JsonMembers, ACountIsWholeAndAtLeastOne) {
  for (const nlohmann::json& value : {nlohmann::json(0), nlohmann::json(2.5), nlohmann::json(1000001)})
    EXPECT_EQ(refusal([&] {
                count_from_json({{"n", value}}, "n", "file");
              }),
              "n: expected a whole number of at least 1");
}

}  // namespace
}  // namespace faultline
