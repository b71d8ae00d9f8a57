// SPDX-License-Identifier: MIT
#include "lib/core/utf8.hpp"

#include <gtest/gtest.h>

namespace faultline {
namespace {

TEST(Utf8, ValidTextStays) {
  for (const char* text : {"", "plain", "caf\xc3\xa9", "\xe2\x86\x92", "\xf0\x9f\xa4\x96", "\xef\xbf\xbd"})
    EXPECT_EQ(valid_utf8(text), text);
}

TEST(Utf8, InvalidBytesAreReplacedOneByOne) {
  const std::string mark = "\xef\xbf\xbd";
  EXPECT_EQ(valid_utf8("a\xff"), "a" + mark);
  EXPECT_EQ(valid_utf8("\xc3"), mark);
  EXPECT_EQ(valid_utf8("\xc0\xaf"), mark + mark) << "overlong";
  EXPECT_EQ(valid_utf8("\xed\xa0\x80"), mark + mark + mark) << "surrogate";
  EXPECT_EQ(valid_utf8("\xf4\x90\x80\x80"), mark + mark + mark + mark) << "beyond Unicode";
  EXPECT_EQ(valid_utf8("\xe2\x86x"), mark + mark + "x") << "cut short";
}

}  // namespace
}  // namespace faultline
