// SPDX-License-Identifier: MIT
#include "lib/model/twin/twin_options.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"
#include "lib/learn/twin.hpp"

namespace faultline {
namespace {

UsualMotion motion_of_two_joints() {
  UsualMotion motion;
  motion.q_low = {-1.0, -2.0};
  motion.q_high = {1.0, 2.0};
  motion.velocity_scale = {0.8, 0.8};
  motion.torque_scale = {10.0, 4.0};
  motion.sizes = {{0.04, 0.08}, {0.04, 0.08}, {2.0, 3.0}, {4.0, 5.0}, {5.0, 2.0}, 1.5};
  return motion;
}

TwinFault& fault_of(TwinOptions& options, FaultKind kind) {
  return options.faults[static_cast<std::size_t>(kind)];
}

SimulatedFault drawn(const TwinOptions& options, FaultKind kind, std::uint64_t seed = 1) {
  const UsualMotion motion = motion_of_two_joints();
  Random random(seed);
  return draw_faults({nullptr, &motion, {}, 0.001, true, options}, {kind, 2_joint}, 3.0, random).front();
}

void expect_refused(const TwinOptions& options, const std::string& key) {
  try {
    options.check();
    ADD_FAILURE() << key << " was not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_EQ(error.where(), "TwinOptions." + key);
  }
}

TEST(TwinOptions, TheDefaultsAreValidAndEqualTheCatalogue) {
  TwinOptions options;
  EXPECT_NO_THROW(options.check());
  EXPECT_EQ(fault_of(options, FaultKind::torque_loss).size[0], describe(FaultKind::torque_loss).size[0].twin);
  EXPECT_EQ(fault_of(options, FaultKind::collision).length_s, describe(FaultKind::collision).twin_length_s);
}

TEST(TwinOptions, ImpossibleOptionsAreRefusedByName) {
  TwinOptions options;
  options.pd_share = 1.5;
  expect_refused(options, "pd_share");
  options = {};
  options.onset = {0.5, 0.2};
  expect_refused(options, "onset");
  options = {};
  options.attempts = 0;
  expect_refused(options, "attempts");
  options = {};
  options.mass_error = std::nan("");
  expect_refused(options, "mass_error");
  options = {};
  fault_of(options, FaultKind::sensor_bias).size[0].low = 0.0;
  expect_refused(options, "faults.sensor_bias");
}

TEST(TwinOptions, JsonKeepsEveryNumber) {
  TwinOptions options;
  options.onset = {0.1, 0.123456789012345678};
  options.attempts = 7;
  fault_of(options, FaultKind::friction_increase).size[1].spread = Spread::uniform;
  fault_of(options, FaultKind::collision).length_s.high = 0.3;
  EXPECT_EQ(twin_from_json(twin_to_json(options), "model"), options);
}

TEST(TwinOptions, DamagedJsonIsRefused) {
  nlohmann::ordered_json json = twin_to_json({});
  json["onset"]["spread"] = "normal";
  EXPECT_THROW(twin_from_json(json, "model"), Error);
  json = twin_to_json({});
  json.erase("attempts");
  EXPECT_THROW(twin_from_json(json, "model"), Error);
}

TEST(TwinText, ShowsTheSizesOfEveryKindThatIsSimulated) {
  const std::string text = twin_text({});
  for (int k = 1; k < static_cast<int>(FaultKind::unknown); ++k)
    EXPECT_NE(text.find(to_string(static_cast<FaultKind>(k))), std::string::npos) << k;
  EXPECT_NE(text.find("+-0.003 to 0.04, log-uniform"), std::string::npos) << text;
}

TEST(TwinFaults, SizesAreSharesOfTheUsualValuesOfTheJoint) {
  TwinOptions options;
  fault_of(options, FaultKind::sensor_bias).size[0] = {0.5, 0.5};
  fault_of(options, FaultKind::friction_increase).size = {{{2.0, 2.0}, {3.0, 3.0}}};
  fault_of(options, FaultKind::payload_change).size[0] = {0.5, 0.5};
  fault_of(options, FaultKind::collision) = {{{{0.25, 0.25}}}, {0.1, 0.1}};
  EXPECT_EQ(drawn(options, FaultKind::sensor_bias).size, 0.5 * 4.0) << "of the range";
  EXPECT_EQ(drawn(options, FaultKind::friction_increase).viscous, 2.0 * 3.0);
  EXPECT_EQ(drawn(options, FaultKind::friction_increase).size, 3.0 * 5.0) << "of the Coulomb friction";
  EXPECT_EQ(drawn(options, FaultKind::payload_change).size, 0.5 * 3.0) << "of the mass carried";
  EXPECT_EQ(drawn(options, FaultKind::collision).size, 0.25 * 4.0) << "of the largest torque";
  EXPECT_EQ(drawn(options, FaultKind::collision).end_s, 3.1);
}

TEST(TwinFaults, SizesStayInTheirRangesOnBothSidesOfZero) {
  const UsualMotion motion = motion_of_two_joints();
  int negative = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const double bias = drawn({}, FaultKind::sensor_bias, seed).size / 4.0;
    EXPECT_GE(std::abs(bias), 0.003 * (1.0 - 1e-12));
    EXPECT_LE(std::abs(bias), 0.04);
    negative += bias < 0.0;
    const double loss = drawn({}, FaultKind::torque_loss, seed).size;
    EXPECT_TRUE(loss >= 0.2 && loss <= 0.9) << loss;
  }
  EXPECT_TRUE(negative > 60 && negative < 140) << negative;
}

}  // namespace
}  // namespace faultline
