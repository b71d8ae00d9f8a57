// SPDX-License-Identifier: MIT
#include "formats/arrays/array_table.hpp"

#include <gtest/gtest.h>

#include "lib/core/error.hpp"
#include "tests/formats/arrays/read_bytes.hpp"

namespace faultline {
namespace {

NamedArray array(const std::string& name, const std::vector<std::int64_t>& shape) {
  NamedArray made;
  made.name = name;
  made.shape = shape;
  return made;
}

std::vector<std::string> names_of(const ArrayTable& table) {
  std::vector<std::string> names;
  for (const RawColumn& column : table.columns) names.push_back(column.name);
  return names;
}

using Names = std::vector<std::string>;

TEST(ArrayTable, TheTimeVectorDeterminesTheNumberOfRows) {
  const ArrayTable table = table_of(
      {array("image", {500, 600}), array("t", {1, 100}), array("q", {2, 100}), array("dt", {})}, "f");
  EXPECT_EQ(table.rows, 100);
  EXPECT_EQ(names_of(table), (Names{"t", "q1", "q2"}));
  ASSERT_TRUE(table.issues.find("array_left_out"));
  EXPECT_NE(table.issues.find("array_left_out")->message.find("\"image\" (500 x 600)"), std::string::npos);
}

TEST(ArrayTable, ASignalThatIsLeftOutIsAWarningAndAListOfConstantsANote) {
  const ArrayTable table =
      table_of({array("t", {100}), array("q", {100, 2}), array("tau", {99, 2}), array("temperature", {500}),
                array("gains", {7}), array("image", {500, 600})},
               "f");
  const Issue* signals = table.issues.find("signal_left_out");
  ASSERT_TRUE(signals);
  EXPECT_EQ(signals->severity, Severity::warning);
  EXPECT_NE(signals->message.find("\"tau\" (99 x 2), \"temperature\" (500) do not fit a table"),
            std::string::npos)
      << signals->message;
  const Issue* others = table.issues.find("array_left_out");
  ASSERT_TRUE(others);
  EXPECT_NE(others->message.find("\"gains\" (7), \"image\" (500 x 600) do not fit a table"),
            std::string::npos)
      << others->message;
}

TEST(ArrayTable, WithoutATimeTheLengthOfMostValuesIsTheNumberOfRows) {
  EXPECT_EQ(table_of({array("a", {7, 900}), array("b", {900}), array("c", {40})}, "f").rows, 900);
}

TEST(ArrayTable, ASampleTimeIsNotATimeVector) {
  EXPECT_EQ(table_of({array("t", {1, 1}), array("q", {300, 2})}, "f").rows, 300);
}

TEST(ArrayTable, ASquareMatrixHasItsSamplesInRowsAndAnIssue) {
  const ArrayTable table = table_of({array("t", {5}), array("q", {5, 5})}, "f");
  EXPECT_FALSE(table.arrays[1].channel_major);
  EXPECT_TRUE(table.issues.find("array_square", "q"));
}

TEST(ArrayTable, TheLastPartOfAPathIsTheNameUnlessTwoShareIt) {
  EXPECT_EQ(names_of(table_of(
                {array("run/t", {9}), array("run/q", {9, 2}), array("a/x", {9}), array("b/x", {9})}, "f")),
            (Names{"t", "q1", "q2", "a/x", "b/x"}));
}

TEST(ArrayTable, UnitsAreReadFromNames) {
  const ArrayTable table = table_of({array("time_ms", {9}), array("q [deg]", {9, 2})}, "f");
  EXPECT_EQ(table.columns[0].unit, "ms");
  EXPECT_EQ(table.columns[2].name, "q2");
  EXPECT_EQ(table.columns[2].unit, "deg");
}

TEST(ArrayTable, AFileWithoutArraysIsRefused) { EXPECT_THROW(table_of({array("x", {})}, "f"), Error); }

TEST(ArrayTable, AParquetFileIsRefusedWithTheCommandThatConvertsIt) {
  const std::string refused = read_bytes(std::string("PAR1\x15\0\x15", 7)).refused;
  EXPECT_NE(refused.find("pandas.read_parquet"), std::string::npos) << refused;
}

}  // namespace
}  // namespace faultline
