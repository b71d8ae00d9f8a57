// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "formats/log_writer.hpp"
#include "formats/open_log.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

/// All channels of two joints, with numbers that need all their bits.
Log full_log(int rows, double start_s) {
  Log log;
  for (JointSignals* signals :
       {&log.q, &log.dq, &log.tau, &log.q_ref, &log.dq_ref, &log.tau_ref, &log.tau_meas})
    signals->assign(2, {});
  log.extra = {{"motor temperature", "degC", {}}, {"mode", "", {}}};
  for (int i = 0; i < rows; ++i) {
    log.time.push_back(start_s + i / 128.0);
    double value = i / 3.0;
    for (JointSignals* signals :
         {&log.q, &log.dq, &log.tau, &log.q_ref, &log.dq_ref, &log.tau_ref, &log.tau_meas})
      for (auto& joint : *signals) joint.push_back(value = value / 7.0 - 1.0);
    log.extra[0].values.push_back(20.0 + value);
    log.extra[1].values.push_back(i % 2);
  }
  return log;
}

void expect_same(const Log& a, const Log& b) {
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.q, b.q);
  EXPECT_EQ(a.dq, b.dq);
  EXPECT_EQ(a.tau, b.tau);
  EXPECT_EQ(a.q_ref, b.q_ref);
  EXPECT_EQ(a.dq_ref, b.dq_ref);
  EXPECT_EQ(a.tau_ref, b.tau_ref);
  EXPECT_EQ(a.tau_meas, b.tau_meas);
  ASSERT_EQ(a.extra.size(), b.extra.size());
  for (std::size_t i = 0; i < a.extra.size(); ++i) {
    EXPECT_EQ(a.extra[i].name, b.extra[i].name);
    EXPECT_EQ(a.extra[i].unit, b.extra[i].unit);
    EXPECT_EQ(a.extra[i].values, b.extra[i].values);
  }
}

TEST(McapFormat, ALogIsReadBackBitForBit) {
  const TemporaryFolder folder;
  for (const double start_s : {0.0, 12.5, 1749315325.0}) {
    const Log log = full_log(3000, start_s);
    write_log(folder.file("log.mcap"), log);
    const auto source = open_log(folder.file("log.mcap"));
    expect_same(read_all(*source), log);
    EXPECT_TRUE(source->issues().empty());
  }
}

TEST(McapFormat, DecimalTimesAreReadBackBitForBit) {
  const TemporaryFolder folder;
  Log log = full_log(2000, 0.0);
  for (int i = 0; i < log.rows(); ++i) log.time[i] = i / 1000.0;
  write_log(folder.file("log.mcap"), log);
  EXPECT_EQ(read_all(*open_log(folder.file("log.mcap"))).time, log.time);
}

TEST(McapFormat, BordersOfSegmentsChangeNoByte) {
  const TemporaryFolder folder;
  const Log log = full_log(5000, 0.0);
  write_log(folder.file("once.mcap"), log);
  const auto writer = create_log(folder.file("parts.mcap"));
  for (int begin = 0; begin < log.rows(); begin += 777)
    writer->write(slice(log, begin, std::min(begin + 777, log.rows())));
  writer->commit();
  EXPECT_EQ(read_file(folder.file("once.mcap")), read_file(folder.file("parts.mcap")));
}

TEST(McapFormat, AMissingValueStaysMissing) {
  const TemporaryFolder folder;
  Log log = full_log(10, 0.0);
  log.tau[1][4] = std::nan("");
  write_log(folder.file("log.mcap"), log);
  const Log back = read_all(*open_log(folder.file("log.mcap")));
  EXPECT_TRUE(std::isnan(back.tau[1][4]));
  EXPECT_EQ(back.tau[1][5], log.tau[1][5]);
}

TEST(McapFormat, ATimeBeforeZeroIsRefusedAndNoFileIsLeft) {
  const TemporaryFolder folder;
  try {
    write_log(folder.file("log.mcap"), full_log(10, -1.0));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::output);
    EXPECT_NE(error.message().find("cannot hold the time -1 s"), std::string::npos) << error.message();
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(McapFormat, ACutFileGivesOnlyTrueRowsAndAnIssue) {
  const TemporaryFolder folder;
  const Log log = full_log(40, 0.0);
  write_log(folder.file("log.mcap"), log);
  const std::string whole = read_file(folder.file("log.mcap"));
  for (std::size_t size = 1; size < whole.size(); size += 7) {
    const std::string path = folder.write("cut.mcap", whole.substr(0, size));
    try {
      const auto source = open_log(path);
      const Log back = read_all(*source);
      ASSERT_EQ(source->identity().rows_read, back.rows() + source->issues().rows_dropped());
      ASSERT_EQ(back.q[0], std::vector<double>(log.q[0].begin(), log.q[0].begin() + back.rows()));
      EXPECT_FALSE(source->issues().empty()) << size;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::input);
    }
  }
}

TEST(McapFormat, TheRobotFileChoosesTopicJointsAndTime) {
  const std::string path =
      std::string(FAULTLINE_SOURCE_DIR) + "/tests/formats/cases/mcap_commanded_beside/input.mcap";
  OpenLogOptions options;
  options.recording = {"/joint_commands", {"joint_2", "joint_1"}, MessageTime::receipt};
  const Log log = read_all(*open_log(path, options));
  EXPECT_EQ(log.q[0][4], 4 / 2.0);
  EXPECT_EQ(log.q[1][4], 4 / 4.0);
  EXPECT_TRUE(log.dq.empty());
  options.recording = {"/nowhere", {}, {}};
  try {
    open_log(path, options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("\"/joint_commands\", \"/joint_states\""), std::string::npos)
        << error.message();
  }
}

}  // namespace
}  // namespace faultline
