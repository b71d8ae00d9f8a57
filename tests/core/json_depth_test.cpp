// SPDX-License-Identifier: MIT
#include "lib/core/json/json_depth.hpp"

#include <gtest/gtest.h>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

TEST(JsonDepth, ListsWithinListsAreRefused) {
  EXPECT_THROW(refuse_deep_json(std::string(65, '['), "x.json"), Error);
  EXPECT_THROW(refuse_deep_json("{\"a\": " + std::string(64, '{'), "x.json"), Error);
  EXPECT_NO_THROW(refuse_deep_json(std::string(64, '[') + std::string(64, ']'), "x.json"));
}

TEST(JsonDepth, TextIsNotNested) {
  EXPECT_NO_THROW(
      refuse_deep_json("[\"" + std::string(100, '[') + "\\\"" + std::string(100, '{') + "\"]", "x"));
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "[{}],";
  EXPECT_NO_THROW(refuse_deep_json("[" + many + "[]]", "x.json"));
}

}  // namespace
}  // namespace faultline
