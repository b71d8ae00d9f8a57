// SPDX-License-Identifier: MIT
#include "lib/core/text.hpp"

#include <gtest/gtest.h>

#include "lib/core/paint.hpp"

namespace faultline {
namespace {

TEST(Text, WrapsAtWordsAndCountsCharactersNotBytes) {
  EXPECT_EQ(wrapped("one two three", "  ", 9), "  one two\n  three\n");
  EXPECT_EQ(wrapped("\xc3\xa9\xc3\xa9 \xc3\xa9\xc3\xa9", "", 5), "\xc3\xa9\xc3\xa9 \xc3\xa9\xc3\xa9\n");
  EXPECT_EQ(wrapped("", "  ", 9), "");
}

TEST(Text, PrintableDropsEscapes) {
  EXPECT_EQ(printable("a\x1b[2J\tb\x7f\xc2\x9b\xc3\xa9"), "a?[2J b??\xc3\xa9");
}

TEST(Text, OneIsNoPlural) {
  EXPECT_EQ(counted(0, "log"), "0 logs");
  EXPECT_EQ(counted(1, "log"), "1 log");
  EXPECT_EQ(counted(2, "log"), "2 logs");
}

TEST(Paint, IsThereOnlyWhenAskedFor) {
  EXPECT_EQ(painted("text", Paint::bold_red, true), "\x1b[1;31mtext\x1b[0m");
  EXPECT_EQ(painted("text", Paint::red, true), "\x1b[31mtext\x1b[0m");
  EXPECT_EQ(painted("text", Paint::red, false), "text");
}

}  // namespace
}  // namespace faultline
