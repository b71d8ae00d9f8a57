// SPDX-License-Identifier: MIT
#include "lib/residual/relation/learn_relations.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"
#include "lib/log/log_source.hpp"
#include "lib/residual/relation/signal_relation.hpp"
#include "tests/residual/relation/driven_joint.hpp"

namespace faultline {
namespace {

std::vector<SignalRelation> learned(const std::vector<Log>& logs,
                                    RelationOptions options = {.period_s = 0.005}) {
  std::vector<MemorySource> sources(logs.begin(), logs.end());
  std::vector<LogSource*> pointers;
  for (MemorySource& source : sources) pointers.push_back(&source);
  return learn_relations(pointers, options);
}

std::vector<Log> two_days() { return {DrivenJoint{.seed = 1}.log(20.0), DrivenJoint{.seed = 2}.log(20.0)}; }

const SignalRelation& of_kind(const std::vector<SignalRelation>& relations, RelationKind kind) {
  for (const SignalRelation& relation : relations)
    if (relation.kind == kind) return relation;
  throw std::runtime_error("no such relation");
}

TEST(LearnRelations, TheDriveOfAHeldOutLogIsPredictedUpToItsNoise) {
  const auto relations = learned(two_days());
  const SignalRelation& drive = of_kind(relations, RelationKind::actuator);
  EXPECT_EQ(drive.target, Quantity::tau_meas);
  EXPECT_EQ(drive.inputs, std::vector<Quantity>{Quantity::tau});
  EXPECT_GT(drive.r2, 0.99);
  // A mean of 20 rows, beside what the command's noise does within a row.
  EXPECT_GT(drive.windows.front().std, 0.02 / std::sqrt(20.0) - 0.001);
  EXPECT_LT(drive.windows.front().std, 0.02);
}

TEST(LearnRelations, ADriveWhoseTorqueDependsOnItsSpeedHasTheSpeedAsInput) {
  std::vector<Log> logs;
  for (const std::uint64_t seed : {1, 2})
    logs.push_back(DrivenJoint{.by_speed = 0.3, .seed = seed}.log(20.0));
  const auto relations = learned(logs);
  const SignalRelation& drive = of_kind(relations, RelationKind::actuator);
  EXPECT_EQ(drive.inputs, (std::vector<Quantity>{Quantity::tau, Quantity::dq}));
  EXPECT_NEAR(drive.weights[0], 1.0, 0.1) << "of the command";
}

TEST(LearnRelations, AnExactSpeedDoesNotReplaceTheCommand) {
  std::vector<Log> logs;
  for (const std::uint64_t seed : {1, 2})
    logs.push_back(DrivenJoint{.noise = 0.2, .reading_noise = 1e-7, .seed = seed}.log(20.0));
  const auto relations = learned(logs);
  EXPECT_NEAR(of_kind(relations, RelationKind::actuator).weights[0], 1.0, 0.2);
}

TEST(LearnRelations, ThePDLawIsFoundWithItsGains) {
  const auto relations = learned(two_days());
  const SignalRelation& law = of_kind(relations, RelationKind::control_law);
  EXPECT_EQ(law.target, Quantity::tau);
  EXPECT_GT(law.r2, 0.999999);
  // The law of q_ref = 1 with all else at rest commands kp.
  EXPECT_NEAR(law.weights[0], 40.0, 0.5);
}

TEST(LearnRelations, ACommandThatFollowsNoLawGivesNoControlLaw) {
  std::vector<Log> logs = two_days();
  Random random(3);
  for (Log& log : logs)
    for (double& tau : log.tau[0]) tau = random.normal();
  for (const SignalRelation& relation : learned(logs)) EXPECT_NE(relation.kind, RelationKind::control_law);
}

TEST(LearnRelations, LogsWithoutReferenceAndSecondTorqueGiveNoRelation) {
  std::vector<Log> logs = two_days();
  for (Log& log : logs) log.q_ref.clear(), log.dq_ref.clear(), log.tau_meas.clear();
  EXPECT_TRUE(learned(logs).empty());
}

TEST(LearnRelations, AMeasuredTorqueFollowsTheCommandedTorque) {
  std::vector<Log> logs = two_days();
  for (Log& log : logs)
    log.tau_ref = std::move(log.tau), log.tau = std::move(log.tau_meas), log.tau_meas.clear();
  const auto relations = learned(logs, {.torque_is_commanded = false, .period_s = 0.005});
  const SignalRelation& drive = of_kind(relations, RelationKind::actuator);
  EXPECT_EQ(drive.target, Quantity::tau);
  EXPECT_EQ(drive.inputs, std::vector<Quantity>{Quantity::tau_ref});
}

TEST(LearnRelations, PartsOfASingleLogAreHeldOutInTurn) {
  EXPECT_EQ(learned({DrivenJoint{}.log(30.0)}).size(), 4u);
}

TEST(LearnRelations, JsonKeepsEveryBit) {
  const auto relations = learned(two_days());
  const nlohmann::json json = relations_to_json(relations);
  const auto again = relations_from_json(nlohmann::json::parse(json.dump()), 1, "model.json");
  EXPECT_EQ(relations_to_json(again), json);
  EXPECT_EQ(again.size(), 4u) << "drive, law, position and velocity";
}

TEST(LearnRelations, AModelWhoseRelationsDoNotFitTogetherIsRefused) {
  const nlohmann::json good = relations_to_json(learned(two_days()));
  const auto refused = [&](const char* key, const nlohmann::json& value) {
    nlohmann::json bad = good;
    bad[0][key] = value;
    EXPECT_THROW(relations_from_json(bad, 1, "model.json"), Error) << key;
  };
  refused("joint", 2);
  refused("weights", {1.0});
  refused("lags", 1000000000);
  refused("period_s", 0.0);
  refused("windows", nlohmann::json::array());
  refused("target", "tau_wrong");
  refused("kind", "wish");
}

}  // namespace
}  // namespace faultline
