// SPDX-License-Identifier: MIT
#include "lib/learn/twin_study.hpp"

#include <gtest/gtest.h>

#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

TEST(TwinStudy, RunsOfTheTwinAreExplainedWithRigidGears) {
  Model model;
  BalanceModel soft = testing::scara_model();
  soft.theta[soft.layout().spring(1)] = 2e-4;
  soft.setting.compliance = Eigen::VectorXd::Constant(3, 1e-4);
  model.explain.robot = soft;
  const Model rigid = with_rigid_gears(model);
  const auto& rows = std::get<BalanceModel>(rigid.explain.robot);
  soft.theta.segment(soft.layout().spring(0), 3).setZero();
  EXPECT_TRUE(rows.setting.compliance.isZero(0.0));
  EXPECT_EQ(rows.theta, soft.theta);
}

}  // namespace
}  // namespace faultline
