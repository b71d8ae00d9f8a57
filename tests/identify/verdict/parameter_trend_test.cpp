// SPDX-License-Identifier: MIT
#include "lib/identify/verdict/parameter_trend.hpp"

#include <gtest/gtest.h>

#include <string>

#include "lib/core/random.hpp"
#include "lib/identify/identify.hpp"
#include "lib/log/log_source.hpp"
#include "lib/report/identification_text.hpp"
#include "tests/identify/closed_form_scara.hpp"

namespace faultline {
namespace {

constexpr int kLogs = 5;

/// Five logs of 6 s, each with another motion; in log i the Coulomb friction of joint 2 is `growth` i larger.
Identification identify_series(double growth, std::uint64_t seed) {
  std::vector<Log> logs;
  std::vector<MemorySource> sources;
  std::vector<LogSource*> pointers;
  for (int i = 0; i < kLogs; ++i) {
    testing::ClosedFormScara scara;
    scara.fc[1] += growth * i;
    testing::ClosedFormRun run;
    run.duration_s = 6.0;
    run.seed = seed * kLogs + static_cast<std::uint64_t>(i);
    logs.push_back(testing::simulate_closed_form(scara, run));
  }
  sources.reserve(kLogs);
  for (const Log& log : logs) sources.emplace_back(log, "log");
  for (MemorySource& source : sources) pointers.push_back(&source);
  Robot robot = preset_robot("RRP");
  robot.log.torque_between_samples = TorqueTiming::held;
  IdentifyOptions options;
  options.method = IdentifyMethod::weak_form;
  options.keep_all = true;
  return identify(pointers, robot, options);
}

TEST(ParameterTrend, GrowingFrictionIsFlaggedOnItsJointAlone) {
  const Identification id = identify_series(0.05, 3);
  ASSERT_FALSE(id.trends.empty());
  for (const ParameterTrend& t : id.trends) {
    EXPECT_EQ(t.flagged(), t.name == "fc_2") << t.name << " " << t.p_same << " " << t.p_level;
    if (t.name != "fc_2") continue;
    EXPECT_TRUE(t.drifts);
    EXPECT_NEAR(t.slope, 0.05, 0.01);
    ASSERT_EQ(t.by_log.size(), 5u);
    EXPECT_LT(t.by_log[0].ci95[1], t.by_log[4].ci95[0]);
  }
  const std::vector<std::string> lines = trend_lines(id);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].find("fc_2 changes from log to log beyond chance"), std::string::npos) << lines[0];
}

TEST(ParameterTrend, EqualLogsAreNotFlagged) {
  for (std::uint64_t seed = 10; seed < 16; ++seed) {
    const Identification id = identify_series(0.0, seed);
    EXPECT_GE(id.trends.size(), 10u);
    for (const ParameterTrend& t : id.trends)
      EXPECT_FALSE(t.flagged()) << seed << " " << t.name << " " << t.p_same << " " << t.p_level;
  }
}

ParameterTrend drawn(double slope, double jump, Random& random) {
  ParameterTrend t;
  for (int i = 0; i < 6; ++i)
    t.by_log.push_back({i, 1.0 + slope * i + (i == 3 ? jump : 0.0) + 0.1 * random.normal(), 0.1, {}});
  return t;
}

TEST(ParameterTrend, ChanceAloneRaisesLessThanTwiceTheStatedRateOfFlags) {
  Random random(4);
  int flagged = 0;
  constexpr int kSeries = 2000;
  for (int k = 0; k < kSeries; ++k) {
    std::vector<ParameterTrend> trends;
    for (int p = 0; p < 10; ++p) trends.push_back(drawn(0.0, 0.0, random));
    for (const ParameterTrend& t : tested_trends(trends)) flagged += t.flagged();
  }
  EXPECT_LT(flagged, 2.0 * kFalseFlags * kSeries);
}

TEST(ParameterTrend, AJumpIsADifferenceButNotADrift) {
  Random random(5);
  const std::vector<ParameterTrend> drawn_trends = {drawn(0.0, 1.5, random), drawn(0.2, 0.0, random)};
  const std::vector<ParameterTrend> trends = tested_trends(drawn_trends);
  EXPECT_TRUE(trends[0].differs);
  EXPECT_FALSE(trends[0].drifts);
  EXPECT_TRUE(trends[1].drifts);
}

}  // namespace
}  // namespace faultline
