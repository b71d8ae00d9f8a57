// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include "lib/core/files/inner_file.hpp"

namespace faultline {
namespace {

TEST(PlainName, IsANameWithoutFoldersAndControlCharacters) {
  for (const char* name :
       {"run.csv", "runs_a.csv-0123456789ab", "..a", "a..", ".hidden", "H\xc3\xb6he 1.csv", "a\\b"})
    EXPECT_TRUE(is_plain_name(name)) << name;
  for (const std::string& name : {std::string(), std::string("."), std::string(".."), std::string("a/b"),
                                  std::string("/etc/passwd"), std::string("../a"), std::string("a/"),
                                  std::string("a\nb"), std::string("a\0b", 3), std::string("a\x7f")})
    EXPECT_FALSE(is_plain_name(name)) << name;
}

TEST(PlainPath, StaysBelowItsFolder) {
  for (const char* path : {"run.csv", "logs/run.csv", "a/b/c"}) EXPECT_TRUE(is_plain_path(path)) << path;
  for (const char* path : {"", "/etc/passwd", "../a", "a/../b", "logs/..", "a//b", "./a", "a/", "logs/a\tb"})
    EXPECT_FALSE(is_plain_path(path)) << path;
}

TEST(PlainLogName, MayHoldControlCharactersButNotLeaveItsFolder) {
  EXPECT_TRUE(is_plain_log_name("runs/a\nb.csv"));
  EXPECT_FALSE(is_plain_log_name("../a.csv"));
  EXPECT_FALSE(is_plain_log_name("/home/a.csv"));
}

}  // namespace
}  // namespace faultline
