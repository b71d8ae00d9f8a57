// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "formats/open_log.hpp"
#include "lib/core/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

using Values = std::vector<double>;

class LogSelectionTest : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) { return folder_.write(name, text); }
  static Log read(const std::string& path, const LogSelection& parts) {
    OpenLogOptions options;
    options.parts = parts;
    return read_all(*open_log(path, options));
  }

  TemporaryFolder folder_;
};

TEST_F(LogSelectionTest, FilesWithoutTimeAreJoinedRowByRow) {
  const std::string position = file("p.csv", "t,q1\n0,1\n1,2\n2,3\n"),
                    current = file("c.csv", "tau1\n10\n20\n30\n");
  const Log log = read(position, {.join = {current}});
  EXPECT_EQ(log.q[0], (Values{1, 2, 3}));
  EXPECT_EQ(log.tau[0], (Values{10, 20, 30}));
}

TEST_F(LogSelectionTest, FilesWithTimeAreJoinedByItAndValuesBetweenRowsAreInterpolated) {
  const std::string position = file("p.csv", "t,q1\n0,1\n1,2\n2,3\n3,4\n");
  const std::string current = file("c.csv", "t [ms],tau1\n0,10\n500,20\n1500,40\n2000,50\n2500,60\n");
  OpenLogOptions options;
  options.parts.join = {current};
  const auto source = open_log(position, options);
  const Log log = read_all(*source);
  EXPECT_EQ(log.time, (Values{0, 1, 2, 3}));
  ASSERT_EQ(log.tau[0].size(), 4u);
  EXPECT_EQ(log.tau[0][0], 10);
  EXPECT_EQ(log.tau[0][1], 30);
  EXPECT_EQ(log.tau[0][2], 50);
  EXPECT_TRUE(std::isnan(log.tau[0][3])) << "nothing follows 2.5 s";
  EXPECT_NE(source->issues().find("join_interpolated"), nullptr);
  ASSERT_NE(source->issues().find("join_without_partner"), nullptr);
  EXPECT_NE(source->issues().find("join_without_partner")->message.find("1 of 4 rows"), std::string::npos);
}

TEST_F(LogSelectionTest, AWideGapOfTheOtherFileIsNotInterpolatedOver) {
  std::string position = "t,q1\n", current = "t,tau1\n";
  for (int i = 0; i < 100; ++i) {
    position += std::to_string(i) + "," + std::to_string(i % 7) + "\n";
    if (i < 40 || i > 60) current += std::to_string(i) + "," + std::to_string(i) + "\n";
  }
  const Log log = read(file("p.csv", position), {.join = {file("c.csv", current)}});
  for (int i = 0; i < 100; ++i) EXPECT_EQ(std::isnan(log.tau[0][i]), i >= 40 && i <= 60) << i;
}

TEST_F(LogSelectionTest, AShorterFileLeavesTheRestMissing) {
  const std::string position = file("p.csv", "t,q1\n0,1\n1,2\n2,3\n"), current = file("c.csv", "tau1\n10\n");
  const Log log = read(position, {.join = {current}});
  EXPECT_EQ(log.rows(), 3);
  EXPECT_EQ(log.tau[0][0], 10);
  EXPECT_TRUE(std::isnan(log.tau[0][2]));
}

TEST_F(LogSelectionTest, AJoinByTimeOfAFileWithoutTimeIsRefused) {
  const std::string position = file("p.csv", "t,q1\n0,1\n1,2\n"), current = file("c.csv", "tau1\n10\n20\n");
  try {
    read(position, {.join = {current}, .by = JoinBy::time});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), current);
    EXPECT_NE(error.message().find("join by row"), std::string::npos);
  }
}

TEST_F(LogSelectionTest, ALogContinuesInTheNextFileWithAnyOrderOfColumns) {
  const std::string first = file("1.csv", "t,q1,tau1\n0,1,5\n1,2,6\n"),
                    next = file("2.csv", "tau1,t,q1\n7,2,3\n8,3,4\n");
  const Log log = read(first, {.then = {next}});
  EXPECT_EQ(log.time, (Values{0, 1, 2, 3}));
  EXPECT_EQ(log.q[0], (Values{1, 2, 3, 4}));
  EXPECT_EQ(log.tau[0], (Values{5, 6, 7, 8}));
}

TEST_F(LogSelectionTest, TheNextFileIsConvertedToTheUnitsOfTheFirst) {
  const std::string first = file("1.csv", "t [s],q1 [mm]\n0,1000\n1,2000\n");
  const std::string next = file("2.csv", "t [ms],q1 [m]\n2000,3\n3000,4\n");
  const Log log = read(first, {.then = {next}});
  EXPECT_EQ(log.time, (Values{0, 1, 2, 3}));
  EXPECT_EQ(log.q[0], (Values{1, 2, 3, 4}));
  EXPECT_THROW(read(first, {.then = {file("3.csv", "t [s],q1 [deg]\n2,3\n3,4\n")}}), Error);
}

TEST_F(LogSelectionTest, RowsOfTheJoinedFileWithoutCounterpartAreReported) {
  const std::string position = file("p.csv", "t,q1\n0,1\n1,2\n"),
                    longer = file("c.csv", "tau1\n10\n20\n30\n40\n");
  OpenLogOptions options;
  options.parts.join = {longer};
  const auto source = open_log(position, options);
  read_all(*source);
  ASSERT_NE(source->issues().find("join_rows_left"), nullptr);
  EXPECT_NE(source->issues().find("join_rows_left")->message.find("2 rows"), std::string::npos);
}

TEST_F(LogSelectionTest, OneRunOfAFileInWhichTheClockRestartsIsRead) {
  std::string text = "t,q1\n";
  for (int run = 0; run < 3; ++run)
    for (int i = 0; i < 50 + 10 * run; ++i)
      text += std::to_string(i) + "," + std::to_string(100 * run + i) + "\n";
  const std::string path = file("runs.csv", text);
  for (int run = 1; run <= 3; ++run) {
    OpenLogOptions options;
    options.parts.run = run;
    options.segment_rows = 50;  // a run begins where a segment does
    const auto source = open_log(path, options);
    const Log log = read_all(*source);
    EXPECT_EQ(log.rows(), 40 + 10 * run);
    EXPECT_EQ(log.q[0].front(), 100 * (run - 1));
    EXPECT_EQ(source->identity().rows_read, log.rows() + source->issues().rows_dropped());
    ASSERT_NE(source->issues().find("clock_restart", "t"), nullptr);
    EXPECT_EQ(source->issues().find("clock_restart", "t")->count, 2);
  }
  try {
    read(path, {.run = 4});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("has no run 4"), std::string::npos) << error.message();
  }
}

TEST_F(LogSelectionTest, RowsThatAreSentTwiceAreNotARestart) {
  std::string text = "t,q1\n";
  for (int i = 0; i < 100; ++i) text += std::to_string(i) + ",1\n";
  for (int i = 70; i < 130; ++i) text += std::to_string(i) + ",1\n";
  OpenLogOptions options;
  const auto source = open_log(file("twice.csv", text), options);
  EXPECT_EQ(read_all(*source).rows(), 130);
  EXPECT_EQ(source->issues().find("clock_restart", "t"), nullptr);
}

}  // namespace
}  // namespace faultline
