// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/explain/explain_log.hpp"
#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

using testing::on_grid;
using testing::scara_model;
using testing::simulate_closed_form;

constexpr double kOnset_s = 4.0;

ExplainModel model() { return {scara_model(), evidence_limits({})}; }

/// A day on which the reading of joint 2 is false from the onset on; its velocity is measured apart.
Log with_reading(double offset, double drift) {
  Log log = simulate_closed_form(testing::of_day(1), testing::run_of(21));
  for (int k = 0; k < log.rows(); ++k)
    if (log.time[k] >= kOnset_s) log.q[1][k] += offset + drift * (log.time[k] - kOnset_s);
  return log;
}

TEST(ExplainAt, AHealthyLogHasNoFaultAtAnyTime) {
  const UniformLog log = on_grid(simulate_closed_form(testing::of_day(1), testing::run_of(21)));
  for (const double onset_s : {2.0, 3.3, 5.0})
    EXPECT_FALSE(explain_at(log, model(), onset_s, kNeverEnds)) << onset_s;
}

TEST(ExplainAt, AFalsePositionIsNamedWithItsSize) {
  const auto bias = explain_at(on_grid(with_reading(0.05, 0.0)), model(), kOnset_s, kNeverEnds);
  ASSERT_TRUE(bias);
  EXPECT_EQ(bias->label(), (FaultLabel{FaultKind::sensor_bias, 2_joint}));
  EXPECT_NEAR(bias->claim.size[0], 0.05, 0.003);
}

TEST(ExplainAt, ADriftThatTheVelocityDoesNotShowIsNamed) {
  const auto drift = explain_at(on_grid(with_reading(0.0, 0.05)), model(), kOnset_s, kNeverEnds);
  ASSERT_TRUE(drift);
  EXPECT_EQ(drift->label(), (FaultLabel{FaultKind::sensor_drift, 2_joint}));
  EXPECT_TRUE(drift->claim.velocity_is_true);
  EXPECT_NEAR(drift->claim.size[0], 0.05, 0.005);
}

TEST(ExplainAt, EveryLabelHasAScoreAndTheBestComesFirst) {
  const auto bias = explain_at(on_grid(with_reading(0.05, 0.0)), model(), kOnset_s, kNeverEnds);
  ASSERT_TRUE(bias);
  EXPECT_GT(bias->scores.size(), 15u);
  for (std::size_t k = 1; k < bias->scores.size(); ++k)
    EXPECT_LE(bias->scores[k].nats, bias->scores[k - 1].nats);
  EXPECT_EQ(bias->scores.front().label(), bias->label());
}

TEST(ExplainAt, ATorqueOffsetIsNamedWithItsSign) {
  Log log = simulate_closed_form(testing::of_day(1), testing::run_of(22));
  for (int k = 0; k < log.rows(); ++k)
    if (log.time[k] >= kOnset_s) log.tau[0][k] += 1.5;
  const auto offset = explain_at(on_grid(std::move(log)), model(), kOnset_s, kNeverEnds);
  ASSERT_TRUE(offset);
  EXPECT_EQ(offset->label(), (FaultLabel{FaultKind::torque_sensor_error, 1_joint}));
  EXPECT_NEAR(offset->claim.size[0], 1.5, 0.1) << "the torque reads too much";
}

}  // namespace
}  // namespace faultline
