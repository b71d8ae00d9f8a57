// SPDX-License-Identifier: MIT
// Robots that pick up and put down a work piece all day.
#include "lib/learn/work_pieces.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <numeric>

#include "lib/identify/days/fit_days.hpp"
#include "lib/learn/consistent_robot.hpp"
#include "tests/learn/small_robot.hpp"
#include "tests/support/rrp_runs.hpp"

namespace faultline {
namespace {

constexpr double kPiece_kg = 1.0;

struct Carried {
  double from_s, to_s;
};

SimulationSpec carrying(SimulationSpec spec, const std::vector<Carried>& pieces) {
  const Joint joint = Joint::at(static_cast<int>(spec.noise.q.size()) - 1);
  for (const Carried& piece : pieces)
    spec.faults.push_back({FaultKind::payload_change, joint, piece.from_s, piece.to_s, kPiece_kg, 0.0});
  return spec;
}

TEST(WorkPieces, RowsWithoutAPieceLieBeforeAndAfterItIsCarried) {
  MemorySource often(simulate(known_rrp(), rrp_run(20.0), 71).log),
      never(simulate(known_rrp(), rrp_run(20.0), 72).log);
  const std::vector<LogSource*> logs = {&often, &never};
  FittedDays days;
  days.model.piece_kg = kPiece_kg;
  const Eigen::VectorXd time_s = Eigen::VectorXd::LinSpaced(200, 0.05, 19.95);
  PiecePath path(200, 0);
  for (int k = 40; k < 80; ++k) path[k] = 1;
  for (int k = 120; k < 160; ++k) path[k] = 1;
  days.pieces = {{time_s, path}, {time_s, PiecePath(200, 0)}};
  const auto rows = rows_without_work_piece(logs, days);
  ASSERT_EQ(rows.size(), 2u);
  ASSERT_EQ(rows[0].size(), 3u);
  EXPECT_EQ(rows[0][0].begin, 0);
  EXPECT_NEAR(static_cast<double>(rows[0][0].end), 400.0, 20.0);
  EXPECT_NEAR(static_cast<double>(rows[0][1].begin), 800.0, 20.0);
  EXPECT_NEAR(static_cast<double>(rows[0][1].end), 1200.0, 20.0);
  EXPECT_NEAR(static_cast<double>(rows[0][2].begin), 1600.0, 20.0);
  ASSERT_EQ(rows[1].size(), 1u) << "a log in which nothing is carried";
  EXPECT_EQ(rows[1][0].begin, 0);
  days.model.piece_kg = 0.0;
  EXPECT_TRUE(rows_without_work_piece(logs, days).empty()) << "a robot that knows of none keeps all rows";
}

TEST(WorkPieces, TheRobotIsIdentifiedFromRowsWithoutAPiece) {
  std::deque<MemorySource> sources;
  for (int day = 0; day < 3; ++day)
    sources.emplace_back(
        simulate(small_robot(), carrying(small_run(24.0), {{3.0, 7.0}, {11.0, 15.0}, {19.0, 22.0}}), 81 + day)
            .log,
        "day.csv");
  std::vector<LogSource*> logs;
  for (MemorySource& source : sources) logs.push_back(&source);
  const auto mass_of = [](const Identification& id) { return id.robot.chain.links.back().mass; };
  const double with_pieces = mass_of(identify(logs, unknown_small_robot()));
  for (MemorySource& source : sources) source.rewind();
  const HealthyRobot robot = healthy_robot(logs, unknown_small_robot(), {}, {});
  EXPECT_NEAR(std::get<BalanceModel>(robot.model.explain.robot).piece_kg, kPiece_kg, 0.03);
  EXPECT_GT(with_pieces, 2.2) << "the piece is carried half of the time";
  EXPECT_NEAR(mass_of(robot.identification), 2.0, 0.05);
}

TEST(WorkPieces, StaticFrictionThatHoldsADriveAtRestIsNotAWorkPiece) {
  Robot geared = small_robot();
  geared.chain.rotor_inertia = {20.0};
  const double friction = geared.chain.friction[0].coulomb, held[] = {0.9, -0.9, 0.8};  // share, by day
  std::deque<MemorySource> sources;
  std::vector<LogSource*> logs;
  for (int day = 0; day < 3; ++day) {
    Log log = simulate(geared, small_run(20.0), 101 + day).log;
    const double weight = std::reduce(log.tau[0].begin(), log.tau[0].end()) / log.rows();
    for (int stay = 0; stay < 4; ++stay) {
      const int last = log.rows() - 1;
      const double start_s = log.time[last] + 0.3;  // without rows, so that no kernel joins motion and rest
      for (int k = 0; k < 250; ++k) {
        log.time.push_back(start_s + 0.01 * k);
        log.q[0].push_back(log.q[0][last]);
        log.dq[0].push_back(0.0);
        log.tau[0].push_back(weight + (stay % 2 == 0 ? 1.0 : -1.0) * held[day] * friction);
      }
    }
    logs.push_back(&sources.emplace_back(std::move(log), "day.csv"));
  }
  const BalanceModel model = fit_days(logs, parameter_space(unknown_small_robot()), TorqueTiming::held).model;
  EXPECT_GT(model.stiction[0], 0.8 * friction);
  EXPECT_EQ(model.piece_kg, 0.0);
}

/// What a robot that was learned without a work piece says of a log in which one is carried.
std::vector<ExplainedFault> faults_with_piece(double stated_kg) {
  std::deque<MemorySource> sources;
  for (int day = 0; day < 3; ++day)
    sources.emplace_back(simulate(small_robot(), small_run(20.0), 91 + day).log, "day.csv");
  std::vector<LogSource*> logs;
  for (MemorySource& source : sources) logs.push_back(&source);
  Robot robot = unknown_small_robot();
  robot.normal.work_piece_kg = stated_kg;
  const Model model = explained_robot(logs, robot, {}).robot.model;
  MemorySource carried(simulate(small_robot(), carrying(small_run(20.0), {{5.0, 12.0}}), 95).log);
  return explain_whole_log(uniform_log(carried, model.sample_period_s), model.explain).faults;
}

TEST(WorkPieces, APieceThatTheRobotFileStatesIsNotAFault) {
  const std::vector<ExplainedFault> unstated = faults_with_piece(0.0);
  ASSERT_FALSE(unstated.empty());
  EXPECT_EQ(unstated.front().claim.kind, FaultKind::payload_change);
  EXPECT_TRUE(faults_with_piece(kPiece_kg).empty());
}

}  // namespace
}  // namespace faultline
