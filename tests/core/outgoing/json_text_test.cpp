// SPDX-License-Identifier: MIT
#include "lib/core/outgoing/json_text.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace faultline {
namespace {

TEST(JsonText, EscapesTerminalCommands) {
  const std::string name = "\x1b[2J\x7f\xc2\x9b\xe2\x80\xae\xc3\xa9";
  const std::string text = json_text({{"name", name}});
  EXPECT_EQ(text, "{\n  \"name\": \"\\u001b[2J\\u007f\\u009b\\u202e\xc3\xa9\"\n}\n");
  EXPECT_EQ(nlohmann::json::parse(text).at("name"), name) << "it reads back as it was";
}

TEST(JsonText, ReplacesInvalidUtf8) {
  EXPECT_EQ(json_text({{"a", "\xff"}}), "{\n  \"a\": \"\xef\xbf\xbd\"\n}\n");
}

TEST(InsideScript, JsonCannotEndTheScriptAndKeepsItsContent) {
  const nlohmann::json json{{"name", "</script><!-- <b>run 1</b> & 'x'"}, {"values", {1, 2.5}}};
  const std::string text = inside_script(json.dump());
  EXPECT_EQ(text.find('<'), std::string::npos) << text;
  EXPECT_EQ(nlohmann::json::parse(text), json);
}

}  // namespace
}  // namespace faultline
