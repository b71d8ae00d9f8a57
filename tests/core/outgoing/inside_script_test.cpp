// SPDX-License-Identifier: MIT
#include "lib/core/outgoing/inside_script.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace faultline {
namespace {

TEST(InsideScript, NothingCanEndTheScriptAndTheJsonSaysTheSame) {
  const nlohmann::json json{{"name", "</script><!-- <b>run 1</b> & 'x'"}, {"values", {1, 2.5}}};
  const std::string text = inside_script(json.dump());
  EXPECT_EQ(text.find('<'), std::string::npos) << text;
  EXPECT_EQ(nlohmann::json::parse(text), json);
}

}  // namespace
}  // namespace faultline
