// SPDX-License-Identifier: MIT
#include "lib/core/json_members.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

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

TEST(JsonMembers, AreReadAsWhatTheyAre) {
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

TEST(JsonMembers, AnotherKindOfValueIsRefused) {
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
