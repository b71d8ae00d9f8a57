// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/log/channel_names.hpp"
#include "lib/log/log.hpp"

namespace faultline {
namespace {

Log two_joints() {
  Log log;
  log.time = {0.0, 0.1};
  log.q = {{1.0, 2.0}, {3.0, 4.0}};
  log.tau = {{5.0, 6.0}, {7.0, 8.0}};
  log.extra = {{"load", "kg", {9.0, 10.0}}};
  return log;
}

TEST(LogChannels, OfJointsComeInTheOrderOfColumns) {
  const Log log = two_joints();
  std::string names;
  for_each_joint_channel(log, [&](const std::vector<double>& values, Channel channel) {
    names += to_string(channel) + "=" + std::to_string(static_cast<int>(values[0])) + " ";
  });
  EXPECT_EQ(names, "q1=1 q2=3 tau1=5 tau2=7 ");
}

TEST(LogChannels, EveryQuantityHasItsOwnSignals) {
  Log log;
  for (const Quantity quantity : kJointQuantities) signals_of(log, quantity).resize(1);
  for (const JointSignals* signals : {&log.q, &log.dq, &log.tau, &log.q_ref, &log.dq_ref})
    EXPECT_EQ(signals->size(), 1u);
}

TEST(LogChannels, ColumnsOfTwoLogsArePairedAndTheirNamesCopied) {
  const Log from = two_joints();
  Log to;
  to.dq.resize(2);
  int columns = 0;
  for_each_column(to, from, [&](std::vector<double>& mine, const std::vector<double>& theirs) {
    mine = theirs;
    ++columns;
  });
  EXPECT_EQ(columns, 6);
  EXPECT_TRUE(to.dq.empty()) << "a channel that the other log does not have";
  EXPECT_EQ(to.tau, from.tau);
  EXPECT_EQ(to.extra[0].name, "load");
  EXPECT_EQ(to.extra[0].values, from.extra[0].values);
}

TEST(LogChannels, TheEnglishNamesOfKukaAreUnderstood) {
  EXPECT_EQ(parse_name("Real Axis Velocity A2").quantity, Quantity::dq);
  EXPECT_EQ(parse_name("ActVelo_A1").quantity, Quantity::dq);
  EXPECT_EQ(parse_name("Nominal axis position A3").quantity, Quantity::q_ref);
}

}  // namespace
}  // namespace faultline
