// SPDX-License-Identifier: MIT
#include "lib/learn/twin_study.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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

constexpr FaultLabel kLoss{FaultKind::torque_loss, 1_joint};

MonitoredRun run(const FaultLabel& label, double size, bool found) {
  MonitoredRun out;
  out.label = label;
  out.onset_s = 2.0;
  out.size = size;
  if (found) {
    MonitoredEpisode episode;
    episode.fault.alarm_s = 2.1;
    out.log.episodes.push_back(episode);
  }
  return out;
}

std::vector<MonitoredRun> runs_found_from(double size) {
  std::vector<MonitoredRun> runs;
  for (int i = 1; i <= 20; ++i) runs.push_back(run(kLoss, (i % 2 ? -0.05 : 0.05) * i, 0.05 * i >= size));
  return runs;
}

TEST(Detectability, IsTheSizeThatNineOfTenLogsShow) {
  const std::vector<Detectability> reach =
      detectability_of(runs_found_from(0.35), {{{kLoss, 0.3}}, {{kLoss, 0.1}}, {{kLoss, 0.2}}});
  ASSERT_EQ(reach.size(), 1u);
  EXPECT_EQ(reach[0].label, kLoss);
  EXPECT_EQ(reach[0].runs, 20);
  EXPECT_EQ(reach[0].found, 14);
  EXPECT_EQ(reach[0].size, 0.3);
  EXPECT_NEAR(reach[0].least_size, 0.05, 1e-12);
  EXPECT_NEAR(reach[0].median_delay_s, 0.1, 1e-12);
}

TEST(Detectability, HasNoSizeIfMoreThanOneLogInTenShowsNone) {
  const double never = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(std::isnan(
      detectability_of(runs_found_from(0.9), {{{kLoss, never}}, {{kLoss, 0.1}}, {{kLoss, never}}})[0].size));
  EXPECT_TRUE(std::isnan(detectability_of(runs_found_from(0.9), {})[0].size));
}

TEST(Detectability, AnAlarmBeforeTheOnsetFindsNothing) {
  std::vector<MonitoredRun> runs = runs_found_from(0.0);
  for (MonitoredRun& each : runs) each.log.episodes[0].fault.alarm_s = 1.0;
  EXPECT_EQ(detectability_of(runs, {})[0].found, 0);
}

TEST(Detectability, AKindWithoutASizeIsCounted) {
  const FaultLabel locked{FaultKind::locked, 2_joint};
  const std::vector<Detectability> reach =
      detectability_of(std::vector<MonitoredRun>{run(locked, std::nan(""), true)}, {});
  EXPECT_EQ(reach[0].found, 1);
  EXPECT_TRUE(std::isnan(reach[0].size));
}

}  // namespace
}  // namespace faultline
