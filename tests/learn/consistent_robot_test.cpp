// SPDX-License-Identifier: MIT
#include "lib/learn/consistent_robot.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "formats/open_log.hpp"
#include "lib/core/error.hpp"
#include "lib/diagnose/diagnose.hpp"
#include "lib/learn/model_caveats.hpp"
#include "lib/learn/training_cases.hpp"
#include "lib/robot/robot_file.hpp"
#include "tests/learn/small_robot.hpp"

namespace faultline {
namespace {

struct Given {
  std::deque<MemorySource> logs;
  std::vector<LogSource*> sources;

  void add(const std::string& name, std::vector<SimulatedFault> faults, double duration_s = 12.0) {
    SimulationSpec spec = small_run(duration_s);
    spec.faults = std::move(faults);
    sources.push_back(&logs.emplace_back(
        simulate(small_robot(), spec, 50 + static_cast<std::uint64_t>(logs.size())).log, name));
  }
};

SimulatedFault weak_drive() {
  return {FaultKind::torque_loss, 1_joint, 7.0, std::numeric_limits<double>::infinity(), 0.4, 0.0};
}

TEST(ConsistentRobot, ALogWithAFaultAmongHealthyOnesIsNamedAndLeftOut) {
  Given given;
  given.add("a.csv", {});
  given.add("weak.csv", {weak_drive()});
  given.add("c.csv", {});
  const ExplainedRobot trusted = consistent_robot(given.sources, unknown_small_robot(), {});
  const HealthyRobot& robot = trusted.robot;
  ASSERT_EQ(robot.given.size(), 3u);
  EXPECT_FALSE(robot.given[0].left_out);
  EXPECT_TRUE(robot.given[1].left_out);
  EXPECT_FALSE(robot.given[2].left_out);
  EXPECT_EQ(robot.logs.size(), 2u);
  const Issue* issue = robot.identification.issues.find("suspicious_log_2");
  ASSERT_NE(issue, nullptr);
  EXPECT_NE(issue->message.find("weak.csv"), std::string::npos);
  EXPECT_NE(issue->message.find("torque_loss"), std::string::npos) << issue->message;
  EXPECT_TRUE(trusted.doubts.empty());
}

TEST(ConsistentRobot, AtACoarseRateALogThatContradictsTheOthersIsLeftOut) {
  const std::string folder = FAULTLINE_SOURCE_DIR "/sample_logs/bench/";
  std::deque<std::unique_ptr<LogSource>> logs;
  std::vector<LogSource*> sources;
  for (const char* name : {"healthy_1.csv", "healthy_2.csv", "free_swinging_2.csv"})
    sources.push_back(logs.emplace_back(open_log(folder + name)).get());
  const ExplainedRobot trusted = consistent_robot(sources, load_robot_file(folder + "robot.toml"), {});
  const std::vector<IdentifiedLog>& given = trusted.robot.given;
  ASSERT_EQ(given.size(), 3u);
  EXPECT_FALSE(given[0].left_out);
  EXPECT_FALSE(given[1].left_out);
  EXPECT_TRUE(given[2].left_out);
}

TEST(ConsistentRobot, HealthyLogsAreAllKept) {
  Given given;
  for (const char* name : {"a.csv", "b.csv", "c.csv", "d.csv"}) given.add(name, {});
  const ExplainedRobot trusted = consistent_robot(given.sources, unknown_small_robot(), {});
  for (const IdentifiedLog& log : trusted.robot.given) EXPECT_FALSE(log.left_out) << log.path;
  EXPECT_TRUE(trusted.doubts.empty());
}

TEST(ConsistentRobot, TwoLogsThatContradictEachOtherAreKeptWithACaveat) {
  Given given;
  given.add("a.csv", {});
  given.add("weak.csv", {weak_drive()});
  const ExplainedRobot trusted = consistent_robot(given.sources, unknown_small_robot(), {});
  for (const IdentifiedLog& log : trusted.robot.given) EXPECT_FALSE(log.left_out) << log.path;
  ASSERT_EQ(trusted.doubts.size(), 1u);
  EXPECT_NE(trusted.doubts[0].find(".csv"), std::string::npos) << trusted.doubts[0];
}

TEST(ConsistentRobot, AnOptionKeepsAllLogsWithACaveat) {
  Given given;
  given.add("a.csv", {});
  given.add("b.csv", {});
  given.add("weak.csv", {weak_drive()});
  ExplainedRobotOptions options;
  options.identify.keep_all = true;
  const ExplainedRobot trusted = consistent_robot(given.sources, unknown_small_robot(), options);
  EXPECT_EQ(trusted.robot.logs.size(), 3u);
  EXPECT_EQ(trusted.doubts.size(), 1u);
}

TEST(LearnCaveats, ARobotThatDoesNotExplainItsLogsIsRefused) {
  Log log = simulate(small_robot(), small_run(12.0), 50).log;
  for (auto& joint : log.tau)
    for (double& value : joint) value = -value;
  MemorySource wrong(log, "wrong.csv");
  const std::vector<LogSource*> logs = {&wrong};
  try {
    learn(logs, {}, unknown_small_robot(), quick_learning());
    FAIL() << "it was learned";
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("does not explain"), std::string::npos) << error.what();
    EXPECT_NE(error.message().find("--force"), std::string::npos) << error.what();
  }
}

TEST(LearnCaveats, TheReasonIsStatedIfNoSimulatedFaultShows) {
  try {
    training_cases({}, Model{});
    FAIL() << "nothing to train on was enough";
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("0 of 0 simulated faults show"), std::string::npos) << error.what();
  }
}

TEST(LearnCaveats, AForcedModelIsMarkedAndEachDiagnosisStatesTheReason) {
  Given given;
  given.add("a.csv", {});
  given.add("weak.csv", {weak_drive()});
  LearnOptions forced = quick_learning();
  forced.keep_doubtful = true;
  const Learned learned = learn(given.sources, {}, unknown_small_robot(), forced);
  ASSERT_FALSE(learned.model.doubts.empty());
  const Model read = model_from_json(model_to_json(learned.model), "model");
  EXPECT_EQ(read.doubts, learned.model.doubts);
  EXPECT_EQ(read.grave_doubts, learned.model.grave_doubts);
  given.sources[0]->rewind();
  const Diagnosis diagnosis = diagnose(*given.sources[0], read, learned.cases);
  EXPECT_NE(diagnosis.verdict, Verdict::healthy) << "of logs that contradict each other one is faulty";
  ASSERT_FALSE(diagnosis.model.notes.empty());
  EXPECT_NE(diagnosis.model.notes[0].find(read.doubts[0]), std::string::npos);
}

TEST(ModelCaveats, AnUnexplainedRobotIsAGraveAndAPoorlyExplainedOneAMinorCaveat) {
  Identification identification;
  identification.status = IdentificationStatus::unexplained;
  EXPECT_TRUE(caveats_of(identification).is_grave());
  identification.status = IdentificationStatus::poorly_explained;
  EXPECT_FALSE(caveats_of(identification).is_grave());
  EXPECT_EQ(listed(caveats_of(identification)).size(), 1u);
  identification.status = IdentificationStatus::poorly_excited;
  EXPECT_TRUE(listed(caveats_of(identification)).empty());
}

TEST(ModelCaveats, OnlyMinorCaveatsAllowAHealthyVerdict) {
  const ModelCaveats doubts{{"grave"}, {"contradicting"}, {"minor"}};
  EXPECT_EQ(against_healthy(doubts), (std::vector<std::string>{"grave", "contradicting"}));
  EXPECT_EQ(listed(doubts), (std::vector<std::string>{"grave", "contradicting", "minor"}));
}

TEST(ModelCaveats, AModelWithMissedFaultsOrFalseAlarmsHasACaveat) {
  Validation validation;
  ValidationRow& row = validation.rows.emplace_back();
  row.runs = 100;
  row.detected = 98;
  row.right_or_named = 97;
  EXPECT_TRUE(listed(caveats_of(validation, false)).empty());
  validation.false_alarms = 2;
  EXPECT_EQ(caveats_of(validation, false).minor.size(), 1u);
  row.detected = 50;
  EXPECT_EQ(caveats_of(validation, false).minor.size(), 2u);
  EXPECT_FALSE(caveats_of(validation, false).is_grave());
  row.detected = 20;
  EXPECT_TRUE(caveats_of(validation, false).is_grave());
  EXPECT_THROW(refuse_grave(caveats_of(validation, false)), Error);
  EXPECT_FALSE(caveats_of(validation, true).is_grave()) << "second residuals judge, too";
}

TEST(ModelCaveats, SurelyNegativeFrictionIsACaveat) {
  Identification identification;
  identification.status = IdentificationStatus::converged;
  auto friction = [&](const char* name, double value, double half_width) {
    ParameterEstimate& parameter = identification.base_parameters.emplace_back();
    parameter.name = name;
    parameter.value = value;
    parameter.ci95 = {value - half_width, value + half_width};
    parameter.identifiable = true;
  };
  friction("fv_1", -0.4, 0.1);
  friction("fc_1", -0.1, 0.2);
  const ModelCaveats doubts = caveats_of(identification);
  ASSERT_EQ(doubts.minor.size(), 1u);
  EXPECT_NE(doubts.minor[0].find("fv_1"), std::string::npos);
}

}  // namespace
}  // namespace faultline
