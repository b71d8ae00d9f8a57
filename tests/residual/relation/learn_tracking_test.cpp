// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/log/log_source.hpp"
#include "lib/residual/relation/learn_relations.hpp"
#include "lib/residual/relation/relation_detector.hpp"
#include "tests/residual/relation/stepped_joint.hpp"

namespace faultline {
namespace {

std::vector<SignalRelation> learned(const SteppedJoint& joint) {
  std::vector<MemorySource> days;
  for (const std::uint64_t seed : {1, 2, 3}) {
    SteppedJoint day = joint;
    day.seed = seed;
    days.emplace_back(day.log(30.0));
  }
  std::vector<LogSource*> pointers;
  for (MemorySource& day : days) pointers.push_back(&day);
  return learn_relations(pointers, {.period_s = joint.period_s});
}

const std::vector<SignalRelation>& stiff() {
  static const std::vector<SignalRelation> relations = learned({});
  return relations;
}

std::vector<RelationEpisode> watched(const std::vector<SignalRelation>& relations, const Log& log,
                                     Quantity target) {
  for (const SignalRelation& relation : relations) {
    if (relation.target != target) continue;
    RelationDetector watch(relation);
    watch.take(log);
    watch.finish();
    return watch.episodes();
  }
  throw std::runtime_error("no such relation");
}

TEST(LearnTracking, PositionAndVelocityFollowTheirReferences) {
  ASSERT_EQ(stiff().size(), 2u);
  for (const SignalRelation& relation : stiff()) {
    EXPECT_EQ(relation.kind, RelationKind::tracking);
    EXPECT_GT(relation.r2, 0.99);
  }
}

TEST(LearnTracking, HealthyDaysRaiseNoAlarmAlsoWithLostRows) {
  for (std::uint64_t seed = 10; seed < 20; ++seed) {
    const Log log = SteppedJoint{.seed = seed}.log(40.0);
    Log some;
    resize_like(some, log, 0);
    for (int k = 0; k < log.rows(); ++k)
      if (k % 17 != 3 && k % 29 > 2) append(some, slice(log, k, k + 1));
    for (const Quantity target : {Quantity::q, Quantity::dq}) {
      EXPECT_TRUE(watched(stiff(), log, target).empty()) << seed;
      EXPECT_TRUE(watched(stiff(), some, target).empty()) << seed;
    }
  }
}

TEST(LearnTracking, AStallIsFoundWithItsTimeInPositionAndVelocity) {
  const Log log = SteppedJoint{.stall_from_s = 12.0, .stall_to_s = 12.6, .seed = 21}.log(30.0);
  const auto position = watched(stiff(), log, Quantity::q);
  ASSERT_FALSE(position.empty());
  EXPECT_NEAR(position[0].onset_s, 12.0, 0.15);
  EXPECT_LT(position[0].alarm_s, 12.4);
  const auto velocity = watched(stiff(), log, Quantity::dq);
  ASSERT_FALSE(velocity.empty());
  EXPECT_NEAR(velocity[0].onset_s, 12.0, 0.15);
}

TEST(LearnTracking, LostStepsAreAnEpisodeThatLasts) {
  const Log log =
      SteppedJoint{.stall_from_s = 12.0, .stall_to_s = 12.3, .counts_steps = true, .seed = 22}.log(30.0);
  const auto position = watched(stiff(), log, Quantity::q);
  ASSERT_EQ(position.size(), 1u);
  EXPECT_TRUE(position[0].lasts);
}

TEST(LearnTracking, ALimitOfTheAccelerationIsFound) {
  // The loop asks for jumps of speed that the drive makes ramps of.
  const SteppedJoint slow{.gain = 0.0, .acceleration = 1.2};
  const auto relations = learned(slow);
  const auto velocity = std::find_if(relations.begin(), relations.end(),
                                     [](const auto& r) { return r.target == Quantity::dq; });
  ASSERT_NE(velocity, relations.end());
  EXPECT_NEAR(velocity->rate_limit, 1.2, 0.1);
  EXPECT_GT(velocity->r2, 0.99);
  EXPECT_TRUE(watched(
                  relations,
                  [&] {
                    SteppedJoint day = slow;
                    day.seed = 11;
                    return day.log(40.0);
                  }(),
                  Quantity::dq)
                  .empty());
}

TEST(LearnTracking, AJointThatDoesNotFollowIsNotJudged) {
  std::vector<Log> logs;
  for (const std::uint64_t seed : {1, 2}) {
    logs.push_back(SteppedJoint{.seed = seed}.log(20.0));
    Random random(seed);
    for (double& q : logs.back().q[0]) q = 1e-4 * random.normal();
    for (double& dq : logs.back().dq[0]) dq = 1e-2 * random.normal();
  }
  std::vector<MemorySource> days(logs.begin(), logs.end());
  std::vector<LogSource*> pointers;
  for (MemorySource& day : days) pointers.push_back(&day);
  EXPECT_TRUE(learn_relations(pointers, {.period_s = 0.01}).empty());
}

}  // namespace
}  // namespace faultline
