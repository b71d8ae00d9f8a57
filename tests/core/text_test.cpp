// SPDX-License-Identifier: MIT
#include "lib/core/text.hpp"

#include <gtest/gtest.h>

#include "lib/core/error.hpp"
#include "lib/core/issue.hpp"

namespace faultline {
namespace {

TEST(Text, WrapsAtWordsAndCountsCharactersNotBytes) {
  EXPECT_EQ(wrapped("one two three", "  ", 9), "  one two\n  three\n");
  EXPECT_EQ(wrapped("\xc3\xa9\xc3\xa9 \xc3\xa9\xc3\xa9", "", 5), "\xc3\xa9\xc3\xa9 \xc3\xa9\xc3\xa9\n");
  EXPECT_EQ(wrapped("", "  ", 9), "");
}

TEST(Text, PrintableReplacesEscapes) {
  EXPECT_EQ(printable("a\x1b[2J\tb\x7f\xc2\x9b\xc3\xa9"), "a?[2J b??\xc3\xa9");
}

TEST(Text, PrintableReplacesMarksOfDirection) {
  EXPECT_EQ(printable("a\xe2\x80\xaegnp.exe\xe2\x81\xa9"), "a?gnp.exe?");
  EXPECT_EQ(printable("\xe2\x82\xac \xe2\x80\x94"), "\xe2\x82\xac \xe2\x80\x94") << "euro sign and dash stay";
}

TEST(Text, ShortenedKeepsBothEndsAndWholeCharacters) {
  EXPECT_EQ(shortened("short", 9), "short");
  EXPECT_EQ(shortened(std::string(100, 'a') + "xyz", 9), "aaaaaa...(103 characters)...xyz");
  EXPECT_EQ(shortened("\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9", 3), "\xc3\xa9\xc3\xa9...(4 characters)...\xc3\xa9");
}

TEST(Text, BriefShortensLongWordsAndLongSentences) {
  EXPECT_EQ(brief("two  words"), "two  words");
  EXPECT_EQ(brief(std::string(400, 'p') + ": no such file"), std::string(400, 'p') + ": no such file");
  EXPECT_LT(brief("has a column \"" + std::string(1 << 16, 'n') + "\" twice").size(), 600u);
  std::string words;
  for (int i = 0; i < 30000; ++i) words += "word ";
  EXPECT_LT(brief(words).size(), 4100u);
}

TEST(Text, OutgoingKeepsOnlyLinesAndColoursOfTheProgram) {
  const std::string text = painted("a", Paint::red, true) + "\n\x1b[2J\x1b]0;title\x07\tb\n";
  EXPECT_EQ(outgoing(text, true), "\x1b[31ma\x1b[0m\n?[2J?]0;title? b\n");
  EXPECT_EQ(outgoing(text, false), "?[31ma?[0m\n?[2J?]0;title? b\n");
}

TEST(Text, MessagesOfErrorsAndIssuesAreShortAndPrintable) {
  const Error error(ErrorCode::input, "a\x1b[2J.csv", "has \"" + std::string(1 << 16, 'n') + "\"\nin it");
  EXPECT_TRUE(std::string(error.what()).starts_with("a?[2J.csv: has \"nnn"));
  EXPECT_LT(error.message().size(), 600u);
  EXPECT_EQ(error.message().find('\n'), std::string::npos);
  EXPECT_EQ(error.where(), "a\x1b[2J.csv") << "what is opened or compared keeps its name";
  Issues issues;
  issues.add({"code", "q1", Severity::note, "cell \"\x1b[2J\""});
  EXPECT_EQ(issues.all()[0].message, "cell \"?[2J\"");
}

TEST(Text, CountedUsesTheSingularForOne) {
  EXPECT_EQ(counted(0, "log"), "0 logs");
  EXPECT_EQ(counted(1, "log"), "1 log");
  EXPECT_EQ(counted(2, "log"), "2 logs");
}

TEST(Paint, IsAddedOnlyOnRequest) {
  EXPECT_EQ(painted("text", Paint::bold_red, true), "\x1b[1;31mtext\x1b[0m");
  EXPECT_EQ(painted("text", Paint::red, true), "\x1b[31mtext\x1b[0m");
  EXPECT_EQ(painted("text", Paint::red, false), "text");
}

TEST(Utf8, ValidTextIsUnchanged) {
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
