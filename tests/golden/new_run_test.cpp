// SPDX-License-Identifier: MIT
#include "lib/golden/new_run.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/error.hpp"
#include "lib/core/random.hpp"

namespace faultline {
namespace {

constexpr double kPeriod = 0.01;
constexpr int kRows = 1000;
constexpr double kNoise = 0.02;

struct MadeRun {
  double friction = 0.0;   ///< of this day, added to the torque in the direction of motion
  double push = 0.0;       ///< torque from 6 s on
  double frequency = 0.3;  ///< Hz: the motion
  double delay_s = 0.0;
};

RunSignals made_run(const std::string& name, std::uint64_t seed, const MadeRun& made) {
  Random random(seed);
  RunSignals run;
  run.name = name;
  run.period_s = kPeriod;
  run.length_s = kPeriod * (kRows - 1);
  RunSignal position{"position", 1_joint, {}, {}}, torque{"torque", 1_joint, {}, {}};
  const double w = 2.0 * M_PI * made.frequency;
  for (int k = 0; k < kRows; ++k) {
    const double t = k * kPeriod, phase = w * std::max(0.0, t - made.delay_s);
    position.time.push_back(t);
    torque.time.push_back(t);
    position.values.push_back(std::sin(phase) + std::sin(0.37 * phase) + 1e-4 * random.normal());
    torque.values.push_back(5.0 * std::sin(phase) + made.friction * std::tanh(5.0 * std::cos(phase)) +
                            (t > 6.0 ? made.push : 0.0) + kNoise * random.normal());
  }
  run.signals = {position, torque};
  run.motion = {position};
  return run;
}

std::vector<RunSignals> recorded_days() {
  return {made_run("monday", 1, {0.30}), made_run("tuesday", 2, {0.00}), made_run("friday", 3, {-0.25})};
}

const SignalCheck& torque_of(const NewRunCheck& check) {
  for (const SignalCheck& signal : check.signals)
    if (signal.quantity == "torque") return signal;
  throw std::logic_error("no torque");
}

TEST(NewRun, DaysWithinTheSpreadOfTheRecordedOnesAreAsRecorded) {
  const std::vector<RunSignals> days = recorded_days();
  for (std::uint64_t seed = 10; seed < 14; ++seed) {
    const double friction = -0.3 + 0.2 * static_cast<double>(seed - 10);
    const NewRunCheck check = check_new_run(made_run("new", seed, {friction}), days, {}, {1});
    EXPECT_TRUE(check.same()) << friction << ": " << to_text({check});
    EXPECT_EQ(check.recorded, 3);
  }
  const NewRunCheck alone = check_new_run(made_run("new", 10, {-0.3}), {days[0]}, {}, {1});
  EXPECT_FALSE(alone.same()) << "one recorded run does not show how days differ";
}

TEST(NewRun, OneNewRunIn100LeavesTheToleranceOfFewRuns) {
  Random random(1);
  for (const int recorded : {3, 4, 5, 6}) {
    constexpr int kDraws = 40000;
    int leave = 0;
    for (int draw = 0; draw < kDraws; ++draw) {
      const double fresh = random.normal();
      double low = INFINITY, high = -INFINITY, nearest = INFINITY;
      for (int i = 0; i < recorded; ++i) {
        const double day = random.normal();
        low = std::min(low, day);
        high = std::max(high, day);
        nearest = std::min(nearest, std::abs(day - fresh));
      }
      leave += nearest > few_runs_factor(recorded) * (high - low);
    }
    EXPECT_NEAR(leave / static_cast<double>(kDraws), 0.01, 0.002) << recorded;
  }
  for (int recorded = 2; recorded < 20; ++recorded) EXPECT_GE(few_runs_factor(recorded), 1.0);
}

TEST(NewRun, TheToleranceIsNeverBelowTheSpread) {
  const NewRunCheck check = check_new_run(made_run("new", 5, {0.1}), recorded_days(), {}, {1});
  EXPECT_GT(torque_of(check).tolerance, few_runs_factor(3) * 0.55);
  EXPECT_LT(torque_of(check).tolerance, few_runs_factor(3) * 0.75);
}

TEST(NewRun, WhatTheRecordedRunsDoNotShowIsFoundWithItsTime) {
  const NewRunCheck check = check_new_run(made_run("new", 4, {0.1, 5.0}), recorded_days(), {}, {1});
  ASSERT_NE(check.first_leaving(), nullptr);
  EXPECT_EQ(check.first_leaving()->quantity, "torque");
  EXPECT_NEAR(check.first_leaving()->leaves_s, 6.01, 0.03);
  EXPECT_EQ(check.nearest, "tuesday");
}

TEST(NewRun, ARunThatStartsLaterIsAlignedByItsMotion) {
  EXPECT_TRUE(check_new_run(made_run("new", 6, {0.1, 0.0, 0.3, 0.35}), recorded_days(), {}, {1}).same());
}

TEST(NewRun, AnotherMotionIsNotRecorded) {
  const NewRunCheck check = check_new_run(made_run("new", 7, {0.1, 0.0, 0.9}), recorded_days(), {}, {1});
  EXPECT_EQ(check.nearest, "");
  EXPECT_FALSE(check.same());
  EXPECT_NE(to_text({check}).find("no healthy run of the folder has this motion"), std::string::npos);
  EXPECT_NE(new_runs_junit({check}).find("failures=\"1\""), std::string::npos);
}

TEST(NewRun, AWiderToleranceNeedsAFactorFromOneAndAReason) {
  const auto widened = widened_tolerances(
      "[[widen]]\nsignal = \"torque\"\njoint = 1\nfactor = 4.0\nreason = \"new grease\"\n", "runs.toml");
  const NewRunCheck check = check_new_run(made_run("new", 4, {0.1, 5.0}), recorded_days(), widened, {1});
  EXPECT_TRUE(check.same()) << to_text({check});
  EXPECT_EQ(torque_of(check).reason, "new grease");
  for (const char* text :
       {"[[widen]]\nsignal = \"torque\"\nfactor = 0.5\nreason = \"a\"\n",
        "[[widen]]\nsignal = \"torque\"\nfactor = 2.0\n",
        "[[widen]]\nsignal = \"torque\"\nfactor = 2.0\nreason = \" \"\n",
        "[[widen]]\nsignal = \"heat\"\nfactor = 2.0\nreason = \"a\"\n", "[[wider]]\nsignal = \"torque\"\n"})
    EXPECT_THROW(widened_tolerances(text, "runs.toml"), Error) << text;
}

}  // namespace
}  // namespace faultline
