// SPDX-License-Identifier: MIT
// Texts with many columns or long lines.
#include <fmt/format.h>

#include "formats/csv/csv_fields.hpp"
#include "tests/formats/read_csv.hpp"

namespace faultline {
namespace {

/// "t,q1" and further columns with names of `letters` letters.
std::string wide_table(int columns, int letters, int rows) {
  std::string text = "t,q1";
  for (int i = 2; i < columns; ++i) text += fmt::format(",c{:0{}}", i, letters);
  for (int row = 0; row < rows; ++row) {
    text += fmt::format("\n{},{}", row, 2 * row);
    for (int i = 2; i < columns; ++i) text += fmt::format(",{}", i % 7);
  }
  return text + "\n";
}

TEST(CsvReader, AHeaderLongerThanTheHeadOfTheFileIsRead) {
  for (const char* before : {"", "# made by a machine\nsome words\n"}) {
    const std::string text = before + wide_table(3000, 40, 5);
    const Log log = read_csv(text).log;
    EXPECT_EQ(log.rows(), 5);
    EXPECT_EQ(log.q[0][4], 8.0);
    EXPECT_EQ(log.extra.size(), 2998u);
    EXPECT_EQ(log.extra[0].values[3], 2.0);
  }
}

TEST(CsvReader, AsManyColumnsAsALogMayHaveAreRead) {
  const Log log = read_csv(wide_table(kMostFields, 1, 3)).log;
  EXPECT_EQ(log.rows(), 3);
  EXPECT_EQ(static_cast<int>(log.extra.size()), kMostFields - 2);
}

TEST(CsvReader, MoreColumnsThanALogMayHaveAreRefused) {
  const std::string why = why_refused(wide_table(kMostFields + 1, 1, 3));
  EXPECT_NE(why.find("more than 16384 columns"), std::string::npos) << why;
  EXPECT_NE(why_refused(std::string(1 << 20, ',')).find("columns"), std::string::npos);
}

TEST(CsvReader, AnEndlessHeaderLineIsRefusedBeforeItFillsTheMemory) {
  std::string text = "t,q1";
  while (text.size() < (3u << 20)) text += ",column_of_a_machine";
  EXPECT_NE(why_refused(text + "\n").find("a line of more than 1 MiB near its beginning"), std::string::npos)
      << why_refused(text + "\n");
}

TEST(CsvReader, RowsThatLackMostFieldsAreRefusedBeforeTheyFillTheMemory) {
  std::string text = wide_table(1500, 1, 310);
  for (int row = 310; row < 60000; ++row) text += fmt::format("{},1\n", row);
  const std::string why = why_refused(text);
  EXPECT_NE(why.find("lack most"), std::string::npos) << why;
}

TEST(CsvReader, ALineWithTooManyFieldsIsLeftOut) {
  const auto [log, identity, issues] = read_csv("t,q1\n0,1\n1,2" + std::string(1 << 15, ',') + "3\n2,3\n");
  EXPECT_EQ(log.rows(), 2);
  EXPECT_NE(issues.find("row_too_long"), nullptr);
}

}  // namespace
}  // namespace faultline
