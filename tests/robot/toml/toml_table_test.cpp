// SPDX-License-Identifier: MIT
#include "lib/robot/toml/toml_table.hpp"

#include <gtest/gtest.h>

#include "lib/core/error.hpp"
#include "lib/robot/robot_file.hpp"
#include "lib/simulate/spec_file.hpp"

namespace faultline {
namespace {

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

std::string error_of(const std::string& text) {
  try {
    robot_from_toml(text, "r.toml");
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(TomlDepth, KeysOfManyDotsAreRefused) {
  const std::string deep = "a" + repeated(".a", 35000);
  const std::string three = "\"\"\"";
  for (const std::string& text :
       {deep + " = 1", "[" + deep + "]", "[[" + deep + "]]", "x = {" + deep + " = 1}",
        "x = [" + three + "text" + three + "\", {" + deep + " = 1}]", "# 'comment\n" + deep + " = 1",
        "x = '\\'\n" + deep + " = 1", "a" + repeated(" . \"a\"", 35000) + " = 1",
        "1" + repeated(".1", 35000) + "=1"})
    EXPECT_NE(error_of("axes = \"RRP\"\n" + text).find("is nested deeper than"), std::string::npos)
        << text.substr(0, 40);
}

TEST(TomlDepth, DeeplyNestedBracketsAreRefused) {
  EXPECT_NE(error_of("x = " + repeated("[", 100000)).find("is nested deeper than"), std::string::npos);
  EXPECT_NE(error_of("x = " + repeated("{a=", 100000)).find("is nested deeper than"), std::string::npos);
}

TEST(TomlDepth, TheErrorNamesThePlace) {
  EXPECT_NE(error_of("a = 1\n b" + repeated(".b", 17)).find("r.toml, line 2, column 35"), std::string::npos);
}

TEST(TomlDepth, TextCommentsAndManyNumbersAreNotDeep) {
  const std::string dots = repeated(".", 100), open = repeated("[{", 100);
  for (const std::string& text : {"a = \"" + dots + open + "\\\"" + dots + "\"", "a = '" + dots + open + "'",
                                  "a = \"\"\"\n" + dots + "\n\"" + open + "\"\"\"", "a = 1 # " + dots + open,
                                  "a = [" + repeated("1.5, ", 1000) + "]\n" + repeated("b.c = 0.1\n", 100)})
    EXPECT_EQ(error_of(text).find("is nested deeper than"), std::string::npos) << text.substr(0, 40);
}

TEST(TomlDepth, SpecsHaveTheSameLimitOfDepth) {
  const std::string deep = "a" + repeated(".a", 35000) + " = 1\n";
  EXPECT_THROW(simulation_from_toml(deep, "spec.toml", "."), Error);
}

}  // namespace
}  // namespace faultline
