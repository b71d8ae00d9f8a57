// SPDX-License-Identifier: MIT
#include "lib/log/transformed/coupled_source.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/error.hpp"
#include "lib/core/random.hpp"
#include "lib/log/log.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {
namespace {

Eigen::MatrixXd wrist() {
  Eigen::MatrixXd c(3, 3);
  c << 1, 0, 0, -1, 1, 0, 0.2, 0.5, -2;
  return c;
}

Log random_log(int joints, int rows) {
  Random random(7);
  Log log;
  for (int i = 0; i < rows; ++i) log.time.push_back(0.001 * i);
  for (const Quantity quantity : {Quantity::q, Quantity::dq, Quantity::tau, Quantity::q_ref}) {
    signals_of(log, quantity).resize(joints);
    for (auto& values : signals_of(log, quantity))
      for (int i = 0; i < rows; ++i) values.push_back(random.normal());
  }
  return log;
}

Log joints_of(const Log& log, const Eigen::MatrixXd& coupling, int segment_rows = 4096) {
  return read_all(*coupled(std::make_unique<MemorySource>(log, "drives", segment_rows), coupling));
}

Eigen::Vector3d row(const JointSignals& signals, int i) {
  return {signals[0][i], signals[1][i], signals[2][i]};
}

TEST(CoupledSource, MotionOfTheJointsIsTheMatrixTimesThatOfTheDrives) {
  const Log drives = random_log(3, 20), joints = joints_of(drives, wrist());
  for (int i = 0; i < 20; ++i) {
    EXPECT_LT((row(joints.q, i) - wrist() * row(drives.q, i)).norm(), 1e-14);
    EXPECT_LT((row(joints.dq, i) - wrist() * row(drives.dq, i)).norm(), 1e-14);
    EXPECT_LT((row(joints.q_ref, i) - wrist() * row(drives.q_ref, i)).norm(), 1e-14);
  }
  EXPECT_TRUE(joints.dq_ref.empty());
  EXPECT_EQ(joints.time, drives.time);
}

TEST(CoupledSource, PowerIsTheSameOnBothSides) {
  const Log drives = random_log(3, 20), joints = joints_of(drives, wrist());
  for (int i = 0; i < 20; ++i)
    EXPECT_NEAR(row(joints.tau, i).dot(row(joints.dq, i)), row(drives.tau, i).dot(row(drives.dq, i)), 1e-13);
}

TEST(CoupledSource, SegmentsChangeNothing) {
  const Log drives = random_log(3, 20);
  EXPECT_EQ(joints_of(drives, wrist(), 3).tau, joints_of(drives, wrist()).tau);
}

TEST(CoupledSource, UncoupledUndoesTheCoupling) {
  const Log drives = random_log(3, 20), again = uncoupled(joints_of(drives, wrist()), wrist());
  for (int i = 0; i < 20; ++i) {
    EXPECT_LT((row(again.q, i) - row(drives.q, i)).norm(), 1e-14);
    EXPECT_LT((row(again.tau, i) - row(drives.tau, i)).norm(), 1e-14);
  }
}

TEST(CoupledSource, AMissingValueReachesTheJointsThatDependOnIt) {
  Log drives = random_log(3, 2);
  drives.q[1][0] = drives.tau[2][1] = std::nan("");
  const Log joints = joints_of(drives, wrist());
  EXPECT_EQ(joints.q[0][0], drives.q[0][0]);
  EXPECT_TRUE(std::isnan(joints.q[1][0]));
  EXPECT_TRUE(std::isnan(joints.q[2][0]));
  EXPECT_TRUE(std::isnan(joints.tau[2][1]));
  EXPECT_FALSE(std::isnan(joints.q[1][1]));
}

TEST(CoupledSource, WithoutAMatrixTheLogPassesUnchanged) {
  const Log drives = random_log(3, 5);
  EXPECT_EQ(joints_of(drives, {}).q, drives.q);
  EXPECT_EQ(uncoupled(drives, {}).tau, drives.tau);
}

TEST(CoupledSource, ALogOfAnotherRobotIsRefused) {
  try {
    joints_of(random_log(2, 5), wrist());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    EXPECT_EQ(error.where(), "drives");
    EXPECT_NE(error.message().find("positions of 2 joints"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace faultline
