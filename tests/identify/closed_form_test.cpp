// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "lib/core/error.hpp"
#include "lib/identify/identify.hpp"
#include "lib/log/log_source.hpp"
#include "tests/identify/closed_form_scara.hpp"

namespace faultline {
namespace {

using testing::ClosedFormRun;
using testing::ClosedFormScara;
using testing::simulate_closed_form;

Robot robot_to_identify() {
  Robot robot = preset_robot("RRP");
  robot.log.torque_between_samples = TorqueTiming::held;
  return robot;
}

Identification identify_log(const Log& log, const Robot& robot) {
  MemorySource source(log, "log");
  LogSource* logs[] = {&source};
  return identify(logs, robot);
}

std::vector<double> truth_of(const ClosedFormScara& s) { return {s.a(), s.b(), s.c(), s.m3}; }

const ParameterEstimate& named(const std::vector<ParameterEstimate>& all, const std::string& name) {
  for (const auto& e : all)
    if (e.name == name) return e;
  throw std::runtime_error("no " + name);
}

TEST(IdentifyClosedForm, RecoversBaseParametersAndFriction) {
  const ClosedFormScara scara;
  const Identification id = identify_log(simulate_closed_form(scara, {}), robot_to_identify());
  EXPECT_EQ(id.status, IdentificationStatus::converged) << id.reason;
  EXPECT_EQ(id.method, IdentifyMethod::output_error);
  const std::vector<double> truth = truth_of(scara);
  for (int k = 0; k < 4; ++k) {
    EXPECT_TRUE(id.base_parameters[k].identifiable);
    EXPECT_NEAR(id.base_parameters[k].value / truth[k], 1.0, 0.005) << id.base_parameters[k].name;
  }
  for (int j = 0; j < 3; ++j) {
    const std::string number = std::to_string(j + 1);
    EXPECT_NEAR(named(id.base_parameters, "fv_" + number).value / scara.fv[j], 1.0, 0.1) << number;
    EXPECT_NEAR(named(id.base_parameters, "fc_" + number).value / scara.fc[j], 1.0, 0.1) << number;
    EXPECT_GT(id.fit_r2[j], 0.99);
    EXPECT_NEAR(id.q_noise[j] / 1e-4, 1.0, 0.15);
    EXPECT_NEAR(id.dq_noise[j] / 5e-3, 1.0, 0.15);
  }
}

TEST(IdentifyClosedForm, IntervalsCoverTheTruthAtTheirConfidence) {
  const ClosedFormScara scara;
  const std::vector<double> truth = truth_of(scara);
  int covered = 0, all = 0;
  double square = 0.0;
  for (std::uint64_t seed = 101; seed <= 110; ++seed) {
    ClosedFormRun run;
    run.seed = seed;
    run.duration_s = 3.0;
    const Identification id = identify_log(simulate_closed_form(scara, run), robot_to_identify());
    for (int k = 0; k < 4; ++k, ++all) {
      const ParameterEstimate& e = id.base_parameters[k];
      covered += e.ci95[0] <= truth[k] && truth[k] <= e.ci95[1];
      square += std::pow((e.value - truth[k]) / e.std, 2);
    }
  }
  const double rms = std::sqrt(square / all);
  std::cout << covered << " of " << all << " intervals hold the truth; error / std has rms " << rms << "\n";
  EXPECT_GE(covered, 34);
  EXPECT_GT(rms, 0.5);  // intervals far too wide would also hold the truth
  EXPECT_LT(rms, 1.4);
}

TEST(IdentifyClosedForm, AJointThatNeverMovesIsNamed) {
  ClosedFormRun run;
  run.reach[2] = 0.0;
  const Identification id = identify_log(simulate_closed_form({}, run), robot_to_identify());
  EXPECT_EQ(id.status, IdentificationStatus::poorly_excited);
  EXPECT_NE(id.reason.find("joint 3 never moves"), std::string::npos) << id.reason;
  const ParameterEstimate& friction = named(id.base_parameters, "fv_3");
  EXPECT_FALSE(friction.identifiable);
  EXPECT_EQ(friction.why_not, "joint 3 never moves; give a log in which it moves and reverses");
  EXPECT_TRUE(std::isnan(friction.std));
  EXPECT_FALSE(named(id.base_parameters, "m3").identifiable);  // at rest stiction carries any part of it
  EXPECT_TRUE(named(id.base_parameters, "a").identifiable);
  EXPECT_NEAR(named(id.base_parameters, "a").value / ClosedFormScara().a(), 1.0, 0.005);
}

TEST(IdentifyClosedForm, ParametersThatAreNotIdentifiableStateTheReason) {
  const Identification id = identify_log(simulate_closed_form({}, {}), robot_to_identify());
  int open = 0;
  for (const auto* list : {&id.base_parameters, &id.physical_parameters})
    for (const ParameterEstimate& e : *list) {
      open += !e.identifiable;
      EXPECT_EQ(e.identifiable, e.why_not.empty()) << e.name << ": " << e.why_not;
    }
  EXPECT_GE(open, 4);  // m1, m2, l1, l2 without any fact
  EXPECT_EQ(named(id.physical_parameters, "l1").why_not,
            "give l1, l2, m1 or m2, or a second log with a known payload");
}

TEST(IdentifyClosedForm, GivenFrictionIsKept) {
  Robot robot = robot_to_identify();
  robot.known["fv3"] = {2.0, 0.0};
  robot.chain.friction[2].viscous = 2.0;
  const Identification id = identify_log(simulate_closed_form({}, {}), robot);
  const ParameterEstimate& e = named(id.base_parameters, "fv_3");
  EXPECT_TRUE(e.identifiable);
  EXPECT_EQ(e.value, 2.0);
  EXPECT_EQ(e.std, 0.0);
}

TEST(IdentifyClosedForm, GrossOutliersHardlyMoveTheValues) {
  const ClosedFormScara scara;
  Log log = simulate_closed_form(scara, {});
  Random random(9);
  for (int k = 0; k < log.rows() / 50; ++k) {
    const auto row = random.below(log.time.size());
    const auto joint = random.below(3);
    (k % 2 == 0 ? log.q : log.dq)[joint][row] += random.uniform(-3.0, 3.0);
  }
  const Identification id = identify_log(log, robot_to_identify());
  const std::vector<double> truth = truth_of(scara);
  for (int k = 0; k < 4; ++k)
    EXPECT_NEAR(id.base_parameters[k].value / truth[k], 1.0, 0.01) << id.base_parameters[k].name;
}

TEST(IdentifyClosedForm, ALogWithAKnownPayloadDeterminesMassesAndLengths) {
  ClosedFormScara scara, loaded;
  loaded.payload = 1.0;
  ClosedFormRun run;
  MemorySource empty_handed(simulate_closed_form(scara, run), "somewhere/empty.csv");
  run.seed = 2;
  MemorySource carrying(simulate_closed_form(loaded, run), "somewhere/loaded.csv");
  Robot robot = robot_to_identify();
  robot.payloads["loaded.csv"] = {1.0, 0.0};
  LogSource* logs[] = {&carrying, &empty_handed};
  const Identification id = identify(logs, robot);
  const std::vector<std::pair<std::string, double>> truth = {
      {"m1", scara.m1}, {"m2", scara.m2}, {"m3", scara.m3}, {"l1", scara.l1}, {"l2", scara.l2}};
  for (const auto& [name, value] : truth) {
    const ParameterEstimate& e = named(id.physical_parameters, name);
    EXPECT_TRUE(e.identifiable) << name << ": " << e.why_not;
    EXPECT_NEAR(e.value / value, 1.0, 0.03) << name;
    EXPECT_NEAR(e.value, value, 4.0 * e.std) << name;
  }
  EXPECT_NEAR(named(id.base_parameters, "m3").value, scara.m3, 0.005);  // the robot's own
  ASSERT_EQ(id.logs.size(), 2u);
  EXPECT_EQ(id.logs[0].path, "somewhere/loaded.csv");
  EXPECT_EQ(id.logs[0].payload_kg, 1.0);
  EXPECT_EQ(id.logs[1].payload_kg, 0.0);
}

TEST(IdentifyClosedForm, LogsThatAllCarryAPayloadAreRefused) {
  MemorySource source(simulate_closed_form({}, {}), "loaded.csv");
  Robot robot = robot_to_identify();
  robot.payloads["loaded.csv"] = {1.0, 0.0};
  LogSource* logs[] = {&source};
  try {
    identify(logs, robot);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::input);
    EXPECT_NE(std::string(e.what()).find("without payload"), std::string::npos) << e.what();
  }
}

TEST(IdentifyClosedForm, LogsOfDifferentRatesAreNamed) {
  MemorySource fast(simulate_closed_form({}, {.period_s = 0.004}), "fast.csv");
  MemorySource slow(simulate_closed_form({}, {.seed = 2}), "slow.csv");
  LogSource* logs[] = {&slow, &fast};
  const Identification id = identify(logs, robot_to_identify());
  const Issue* differ = id.issues.find("rates_differ");
  ASSERT_NE(differ, nullptr);
  EXPECT_NE(differ->message.find("0.004 s (fast.csv) to 0.005 s (slow.csv)"), std::string::npos)
      << differ->message;
}

TEST(IdentifyClosedForm, TooShortALogIsRefused) {
  ClosedFormRun run;
  run.duration_s = 0.03;
  try {
    identify_log(simulate_closed_form({}, run), robot_to_identify());
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("longer logs"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace faultline
