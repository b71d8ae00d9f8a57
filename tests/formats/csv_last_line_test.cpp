// SPDX-License-Identifier: MIT
// The last line of a text that does not end with a line break: a whole row, or one that was cut.
#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "tests/formats/read_csv.hpp"

namespace faultline {
namespace {

using RowText = std::function<std::string(int row)>;

std::string table(const RowText& row, int rows, const char* line_end = "\n") {
  std::string text = std::string("t,q1,tau1") + line_end;
  for (int i = 0; i < rows; ++i) text += row(i) + line_end;
  return text;
}

double wave(int row) { return 10.0 * std::sin(0.37 * row + 0.1); }

/// Ways in which programs write numbers.
std::vector<RowText> formats() {
  return {
      [](int i) { return fmt::format("{:.3f},{:.6f},{:.6f}", 0.01 * i, wave(i), wave(2 * i)); },
      [](int i) { return fmt::format("{},{},{}", 0.01 * i, wave(i), wave(2 * i)); },
      [](int i) { return fmt::format("{:g},{:g},{:g}", 0.01 * i, wave(i), wave(2 * i)); },
      [](int i) { return fmt::format("{:.5e},{:.5e},{:.5e}", 0.01 * i, wave(i), 1e-7 * wave(2 * i)); },
      [](int i) {
        return fmt::format("{},{},{}", 0.01 * i, 1e-9 * wave(i), i % 3 ? 1e-9 * wave(i) : wave(i));
      },
      [](int i) { return fmt::format("{},{},{}", i, 2 * i, 31 * i); },
      [](int i) { return fmt::format("{:.2f},{:.2f},{:.2f}", 0.01 * i, wave(i), wave(i)); },
  };
}

TEST(CsvLastLine, NoCutGivesAWrongNumber) {
  for (const RowText& row : formats()) {
    for (const int rows : {40, 1200}) {
      const std::string text = table(row, rows);
      const Log whole = read_csv(text).log;
      const std::size_t last_row = text.rfind('\n', text.size() - 2) + 1;
      for (std::size_t end = last_row + 1; end < text.size(); ++end) {
        const auto [log, identity, issues] = read_csv(text.substr(0, end));
        ASSERT_GE(log.rows(), rows - 1);
        const bool told = issues.find("truncated_last_line") || issues.find("last_line_open");
        EXPECT_TRUE(told) << text.substr(last_row, end - last_row);
        if (log.rows() < rows) continue;
        EXPECT_EQ(log.time.back(), whole.time.back());
        EXPECT_EQ(log.q[0].back(), whole.q[0].back());
        EXPECT_NEAR(log.tau[0].back(), whole.tau[0].back(), 1e-13 * std::abs(whole.tau[0].back()))
            << text.substr(last_row, end - last_row);
      }
    }
  }
}

TEST(CsvLastLine, ACompleteRowIsKeptWithANote) {
  for (const RowText& row : {formats()[0], formats()[3], formats()[6]}) {
    std::string text = table(row, 40);
    text.pop_back();
    const auto [log, identity, issues] = read_csv(text);
    EXPECT_EQ(log.rows(), 40);
    ASSERT_NE(issues.find("last_line_open"), nullptr);
    EXPECT_EQ(issues.find("last_line_open")->severity, Severity::note);
  }
}

TEST(CsvLastLine, ACutRowIsReportedWithItsPlace) {
  const auto [log, identity, issues] = read_csv("t,q1\n0,1.25\n1,1.50\n2,1.7");
  EXPECT_EQ(log.rows(), 2);
  ASSERT_NE(issues.find("truncated_last_line"), nullptr);
  for (const char* word : {"row 3", "line 4", "\"1.7\"", "line break"})
    EXPECT_NE(issues.find("truncated_last_line")->message.find(word), std::string::npos);
  EXPECT_EQ(issues.rows_dropped(), 1);
}

TEST(CsvLastLine, ACarriageReturnEndsTheLastValue) {
  const auto [log, identity, issues] = read_csv("t,q1\r\n0,1.25\r\n1,1.50\r\n2,1.7\r");
  EXPECT_EQ(log.q[0].back(), 1.7);
}

TEST(CsvLastLine, AnEmptyLastValueIsKeptOnlyIfAnEarlierRowHasOneToo) {
  EXPECT_EQ(read_csv("t,q1,x\n0,1,\n1,2,5\n2,3,").log.rows(), 3);
  EXPECT_EQ(read_csv("t,q1,x\n0,1,4\n1,2,5\n2,3,").log.rows(), 2) << "cut behind the separator";
}

TEST(CsvLastLine, IgnoredColumnsAlsoShowACutRow) {
  OpenLogOptions options;
  options.keep_extra = false;
  EXPECT_EQ(read_csv("t,q1,x\n0,1,4.25\n1,2,5.25\n2,3,4.2", options).log.rows(), 2);
}

}  // namespace
}  // namespace faultline
