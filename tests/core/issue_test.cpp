// SPDX-License-Identifier: MIT
#include "lib/core/issue.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace faultline {
namespace {

TEST(IssueJson, MissingFactsOfAnIssueAreNull) {
  EXPECT_EQ(issue_json({"time_gap", "t", Severity::warning, "rows are missing", 17, 0.5, 2, 1}).dump(),
            R"({"code":"time_gap","channel":"t","severity":"warning","message":"rows are missing",)"
            R"("first_row":17,"first_time_s":0.5,"count":2,"rows_dropped":1})");
  const auto bare = issue_json({"other_robot", "", Severity::severe, "it is"});
  for (const char* key : {"channel", "first_row", "first_time_s"}) EXPECT_TRUE(bare.at(key).is_null()) << key;
}

}  // namespace
}  // namespace faultline
