// SPDX-License-Identifier: MIT
// A CSV log read in segments of any size, and read again.
#include "tests/formats/read_csv.hpp"

namespace faultline {
namespace {

/// Everything a reader has to do, in one text.
std::string troubled_text() {
  std::string text = "t,q1,q2,tau1,tau2,note\n";
  for (int i = 0; i < 500; ++i) {
    const std::string row = std::to_string(i);
    std::string time = std::to_string(0.01 * i);
    if (i % 97 == 13) time = "x";
    if (i % 89 == 20) time = "0.05";
    if (i % 71 == 30) time = "1000";
    if (i % 61 == 33) text += "# comment\n\n";
    text += time + "," + row + (i % 53 == 7 ? ",oops" : ",1") + (i % 43 == 4 ? ",inf" : ",2") + ",3";
    text += i % 37 == 5 ? "\n" : i % 31 == 6 ? ",a,b,c\n" : ",a\n";
  }
  return text + "5.01,1";
}

TEST(CsvReader, SegmentSizeChangesNothing) {
  OpenLogOptions options;
  options.segment_rows = 4096;
  const ReadLog whole = read_csv(troubled_text(), options);
  ASSERT_GT(whole.log.rows(), 400);
  ASSERT_GE(whole.issues.all().size(), 8u);
  for (const int rows : {1, 2, 7, 100}) {
    options.segment_rows = rows;
    const ReadLog parts = read_csv(troubled_text(), options);
    EXPECT_EQ(parts.log.time, whole.log.time) << rows;
    EXPECT_EQ(parts.log.q[0], whole.log.q[0]) << rows;
    ASSERT_EQ(parts.issues.all().size(), whole.issues.all().size()) << rows;
    for (std::size_t i = 0; i < whole.issues.all().size(); ++i) {
      EXPECT_EQ(parts.issues.all()[i].code, whole.issues.all()[i].code);
      EXPECT_EQ(parts.issues.all()[i].count, whole.issues.all()[i].count);
      EXPECT_EQ(parts.issues.all()[i].message, whole.issues.all()[i].message);
    }
  }
}

TEST(CsvReader, RewindReadsTheSameAgain) {
  const TemporaryFolder folder;
  const auto source = open_log(folder.write("log.csv", troubled_text()));
  const Log first = read_all(*source);
  const auto issues = source->issues().all().size();
  source->rewind();
  const Log second = read_all(*source);
  EXPECT_EQ(first.time, second.time);
  EXPECT_EQ(first.tau[1], second.tau[1]);
  EXPECT_EQ(source->issues().all().size(), issues);
  EXPECT_EQ(source->identity().sha256, sha256_hex(troubled_text()));
}

/// The same lines, each with a blank at its end, which no row has that is read together with others.
std::string with_blanks_at_ends(const std::string& text) {
  std::string other;
  for (const char c : text) other += c == '\n' ? std::string(" \n") : std::string(1, c);
  return other;
}

/// In which missing values are equal.
std::string as_text(const std::vector<std::vector<double>>& columns) {
  std::string text;
  for (const auto& column : columns)
    for (const double value : column) text += std::to_string(value) + ' ';
  return text;
}

TEST(CsvReader, RowsThatAreReadTogetherAreThoseReadOneByOne) {
  std::string text;
  for (int i = 0; i < 20; ++i) text += i == 0 ? troubled_text() + "\n" : troubled_text().substr(23) + "\r\n";
  const ReadLog together = read_csv(text), single = read_csv(with_blanks_at_ends(text));
  EXPECT_EQ(together.log.time, single.log.time);
  EXPECT_EQ(as_text(together.log.q), as_text(single.log.q));
  EXPECT_EQ(as_text(together.log.tau), as_text(single.log.tau));
  ASSERT_EQ(together.issues.all().size(), single.issues.all().size());
  for (std::size_t i = 0; i < single.issues.all().size(); ++i) {
    EXPECT_EQ(together.issues.all()[i].first_row, single.issues.all()[i].first_row);
    EXPECT_EQ(together.issues.all()[i].count, single.issues.all()[i].count);
  }
}

}  // namespace
}  // namespace faultline
