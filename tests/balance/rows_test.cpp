// SPDX-License-Identifier: MIT
#include "lib/balance/rows.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/balance/measured_residual.hpp"
#include "lib/core/error.hpp"
#include "lib/identify/parameter_space.hpp"
#include "lib/log/log_source.hpp"
#include "tests/identify/closed_form_scara.hpp"

namespace faultline {
namespace {

using testing::ClosedFormRun;
using testing::ClosedFormScara;
using testing::simulate_closed_form;

RowSetting setting_for(double period_s) {
  RowSetting s;
  s.period_s = period_s;
  s.kernel_s = 0.016;
  s.decimation = static_cast<int>(std::lround(0.02 / period_s));
  s.torque_is_held = true;
  s.fusion = Eigen::VectorXd::Zero(3);
  s.friction_width = Eigen::VectorXd::Constant(3, ClosedFormScara{}.width);
  s.compliance = Eigen::VectorXd::Zero(3);
  return s;
}

RigidColumns scara_columns() {
  Robot robot = preset_robot("RRP");
  robot.chain.length = {1.0, 0.8, 0.0};
  const ParameterSpace space = parameter_space(robot);
  return {space.chain, space.lift};
}

Eigen::VectorXd truth(const ClosedFormScara& s, const ColumnLayout& layout) {
  Eigen::VectorXd theta = Eigen::VectorXd::Zero(layout.count());
  theta.head(4) << s.a(), s.b(), s.c(), s.m3;
  for (int j = 0; j < 3; ++j) {
    theta[layout.viscous(j)] = s.fv[j];
    theta[layout.coulomb(j)] = s.fc[j];
  }
  return theta;
}

UniformLog log_of(const ClosedFormRun& run, double lost_from_s = 1e9, double lost_to_s = 1e9) {
  Log log = simulate_closed_form(ClosedFormScara{}, run);
  for (int k = 0; k < log.rows(); ++k)
    if (log.time[k] >= lost_from_s && log.time[k] < lost_to_s) log.q[0][k] = NAN;
  MemorySource source(std::move(log));
  return uniform_log(source, run.period_s);
}

TEST(BalanceRows, TheTrueRobotLeavesAlmostNoResidual) {
  const ClosedFormRun run{.period_s = 0.002, .q_noise = 0.0, .dq_noise = 0.0};
  const RowSetting setting = setting_for(run.period_s);
  const RigidColumns rigid = scara_columns();
  const Eigen::VectorXd theta = truth({}, layout_of(rigid, setting));
  const BalanceRows rows = balance_rows(log_of(run), setting, rigid, theta);
  ASSERT_GT(rows.rows(), 150);
  for (int j = 0; j < 3; ++j) {
    const Eigen::VectorXd left = rows.torque.col(j) - rows.column[j] * theta;
    EXPECT_LT(left.norm() / rows.torque.col(j).norm(), 2e-3) << j;
  }
}

TEST(BalanceRows, TheResidualOfATrajectoryEqualsThatOfItsColumns) {
  const ClosedFormRun run{.period_s = 0.002};
  RowSetting setting = setting_for(run.period_s);
  setting.ripples = {{2_joint, 40.0}};
  setting.drives = {{Eigen::Vector3d(1.0, 1.0, 0.0), 0.03}};
  const RigidColumns rigid = scara_columns();
  Eigen::VectorXd theta = truth({}, layout_of(rigid, setting));
  const ColumnLayout layout = layout_of(rigid, setting);
  theta.segment(layout.ripple(0), 4) << 0.01, -0.02, 0.1, 0.2;
  theta[layout.offset(2)] = 0.3;
  theta[layout.delay(0)] = 0.4;
  theta.segment(layout.drive(0), 3) << 0.05, 0.3, 0.4;
  theta[layout.load(0)] = 0.05, theta[layout.load(1)] = 0.08;
  const UniformLog log = log_of(run);
  const BalanceRows rows = balance_rows(log, setting, rigid, theta);
  const MeasuredResidual residual(log, setting, rigid, theta);
  const Eigen::MatrixXd left = residual.of(reading_of(log, 0), 0);
  for (int j = 0; j < 3; ++j)
    EXPECT_LT((rows.torque.col(j) - rows.column[j] * theta - left.col(j)).norm(), 1e-9) << j;
  const int first = 7;
  const Eigen::MatrixXd later = residual.of(reading_of(log, 1), 1, first);
  ASSERT_EQ(later.rows(), left.rows() - first);
  EXPECT_LT((later - left.bottomRows(later.rows())).norm(), 1e-9);
}

TEST(BalanceRows, LostSamplesMarkTheRowsWhoseKernelCrossesThem) {
  const ClosedFormRun run{.period_s = 0.002};
  const BalanceRows rows =
      balance_rows(log_of(run, 2.0, 2.01), setting_for(run.period_s), scara_columns(), {});
  int lost = 0;
  for (int k = 0; k < rows.rows(); ++k) {
    if (rows.lost[k]) {
      EXPECT_NEAR(rows.time_s[k], 2.005, 0.12);
    }
    if (std::abs(rows.time_s[k] - 2.005) < 0.05) {
      EXPECT_TRUE(rows.lost[k]) << rows.time_s[k];
    }
    lost += rows.lost[k];
  }
  EXPECT_GT(lost, 0);
}

TEST(BalanceRows, ALogShorterThanTheKernelIsRefused) {
  const ClosedFormRun run{.duration_s = 0.1, .period_s = 0.002};
  EXPECT_THROW(balance_rows(log_of(run), setting_for(run.period_s), scara_columns(), {}), Error);
}

}  // namespace
}  // namespace faultline
