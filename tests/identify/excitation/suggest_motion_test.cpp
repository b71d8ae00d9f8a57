// SPDX-License-Identifier: MIT
#include "lib/identify/excitation/suggest_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lib/core/atomic_file.hpp"
#include "lib/identify/identify.hpp"
#include "lib/log/log_source.hpp"
#include "lib/report/identification_text.hpp"
#include "lib/robot/robot_file.hpp"
#include "lib/simulate/spec_file.hpp"
#include "tests/identify/closed_form_scara.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

Robot bare_robot() {
  Robot robot = preset_robot("RRP");
  robot.log.torque_between_samples = TorqueTiming::held;
  robot.known["l1"] = {1.0, 0.0};
  return robot;
}

Identification identify_log(const Log& log) {
  MemorySource source(log, "log");
  LogSource* logs[] = {&source};
  IdentifyOptions options;
  options.method = IdentifyMethod::weak_form;
  return identify(logs, bare_robot(), options);
}

/// Joint 3 rests.
const Identification& poorly_excited() {
  static const Identification id = [] {
    testing::ClosedFormRun run;
    run.duration_s = 8.0;
    run.reach[2] = 0.0;
    return identify_log(testing::simulate_closed_form({}, run));
  }();
  return id;
}

Robot true_robot() {
  const testing::ClosedFormScara scara;
  Robot robot = bare_robot();
  robot = with_masses_and_lengths(robot, {scara.m1, scara.m2, scara.m3}, {scara.l1, scara.l2, 1.0});
  for (int j = 0; j < 3; ++j) {
    robot.chain.friction[j].viscous = scara.fv[j];
    robot.chain.friction[j].coulomb = scara.fc[j];
    robot.chain.friction[j].width = scara.width;
  }
  robot.identified = true;
  return robot;
}

TEST(SuggestMotion, MakesAPoorlyExcitedRobotIdentifiable) {
  const Identification& poor = poorly_excited();
  ASSERT_EQ(poor.status, IdentificationStatus::poorly_excited) << poor.reason;
  const SuggestedMotion motion = suggest_motion(poor, {.candidates = 60});
  EXPECT_GT(motion.condition_of_logs, 100.0 * motion.condition);
  const TemporaryFolder folder;
  write_file(folder.file("robot.toml"), robot_file_text(true_robot()));
  write_file(folder.file("spec.toml"), suggestion_text(motion, "robot.toml"));
  const SimulationFile file = load_simulation_file(folder.file("spec.toml"));
  ASSERT_EQ(file.runs.size(), 1u);
  const SimulatedRun run = simulate(file.robot, file.runs[0].simulation, file.runs[0].seed);
  ASSERT_EQ(run.end, EndReason::complete);
  const Identification cured = identify_log(run.log);
  EXPECT_EQ(cured.status, IdentificationStatus::converged) << cured.reason;
  EXPECT_TRUE(excitation_lines(cured).empty()) << excitation_lines(cured)[0];
}

TEST(SuggestMotion, StaysWithinTheRangesOfTheLogs) {
  const Identification& poor = poorly_excited();
  const SuggestedMotion motion = suggest_motion(poor, {.candidates = 20});
  const Motion reference = reference_motion(poor.robot, motion.simulation, motion.seed);
  Reference at;
  for (double t = 0.0; t < motion.simulation.duration_s; t += 0.003) {
    reference.at(t, at);
    const JointExcitation& seen = poor.excitation.joints[0];
    EXPECT_GT(at.q[0], seen.q_low - 0.01 * (seen.q_high - seen.q_low));
    EXPECT_LT(at.q[0], seen.q_high + 0.01 * (seen.q_high - seen.q_low));
    EXPECT_LT(std::abs(at.dq[0]), 1.01 * std::max(seen.fastest_forward, seen.fastest_back));
  }
  EXPECT_TRUE(motion.joints[2].beyond_logs);
  EXPECT_FALSE(motion.joints[0].beyond_logs);
}

TEST(SuggestMotion, ThreadsDoNotChangeAByte) {
  const auto text = [](int threads) {
    return suggestion_text(suggest_motion(poorly_excited(), {.candidates = 20, .threads = threads}),
                           "robot.toml");
  };
  EXPECT_EQ(text(1), text(2));
}

TEST(Excitation, NamesTheRestingJointAndTheParameterThatItHides) {
  const Excitation& e = poorly_excited().excitation;
  EXPECT_EQ(e.joints[0].lacks, "");
  EXPECT_NE(e.joints[2].lacks.find("never moves"), std::string::npos);
  const auto m3 =
      std::find_if(e.parameters.begin(), e.parameters.end(), [](const auto& p) { return p.name == "m3"; });
  ASSERT_NE(m3, e.parameters.end());
  EXPECT_TRUE(std::isnan(m3->own));
}

TEST(Excitation, ReportsAJointThatMovesInOneDirectionOnly) {
  Log log = testing::simulate_closed_form({}, {});
  const Identification both = identify_log(log);
  for (const JointExcitation& joint : both.excitation.joints) EXPECT_EQ(joint.lacks, "");
  EXPECT_NEAR(both.excitation.joints[0].forward, 0.5, 0.2);
}

}  // namespace
}  // namespace faultline
