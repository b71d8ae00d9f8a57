// SPDX-License-Identifier: MIT
// with_sizes() and clamp_sizes(): what is known of a fault's size before, and what it can be.
#include <gtest/gtest.h>

#include "tests/reproduce/filter/prediction_world.hpp"

namespace faultline {
namespace {

using mechanical::covariance_of;
using mechanical::mean_of;

const MotionModel& model() {
  static const MotionModel model = hand_made_model(known_rrp());
  return model;
}

GaussianState healthy() {
  GaussianState state;
  state.size = 6;
  for (int i = 0; i < 6; ++i) {
    state.mean[i] = 0.1 * i;
    for (int j = 0; j < 6; ++j) state.p(i, j) = i == j ? 2.0 : 0.1;
  }
  return state;
}

Hypothesis hypothesis_of(FaultKind kind, int joint) {
  if (joint == 0 && kind == FaultKind::collision)
    return {.label = {kind, 0}, .form = HypothesisForm::push_on_all_joints, .sizes = 3};
  return {.label = {kind, joint}, .sizes = describe(kind).size_count};
}

/// Means and standard deviations of the sizes behind q and dq.
std::vector<std::pair<double, double>> sizes_of(FaultKind kind, int joint) {
  const GaussianState state = with_sizes(healthy(), hypothesis_of(kind, joint), model().priors);
  std::vector<std::pair<double, double>> out;
  for (int s = 6; s < state.size; ++s) out.emplace_back(state.mean[s], std::sqrt(state.p(s, s)));
  return out;
}

using Sizes = std::vector<std::pair<double, double>>;

void expect_sizes(FaultKind kind, int joint, const Sizes& expected) {
  const Sizes sizes = sizes_of(kind, joint);
  ASSERT_EQ(sizes.size(), expected.size()) << to_string(kind);
  for (std::size_t s = 0; s < sizes.size(); ++s) {
    EXPECT_NEAR(sizes[s].first, expected[s].first, 1e-12) << to_string(kind);
    EXPECT_NEAR(sizes[s].second, expected[s].second, 1e-12) << to_string(kind);
  }
}

TEST(WithSizes, EveryKindHasItsPrior) {
  expect_sizes(FaultKind::free_swinging, 1, {});
  expect_sizes(FaultKind::locked, 2, {});
  expect_sizes(FaultKind::stuck_encoder, 3, {});
  expect_sizes(FaultKind::none, 0, {});
  expect_sizes(FaultKind::torque_loss, 2, {{0.5, 0.3}});
  expect_sizes(FaultKind::sensor_bias, 3, {{0.0, 0.008}});
  expect_sizes(FaultKind::sensor_drift, 1, {{0.0, 0.08}});
  expect_sizes(FaultKind::friction_increase, 2, {{3.0, 3.0}, {4.0, 4.0}});
  expect_sizes(FaultKind::payload_change, 3, {{0.0, 1.25}});
  expect_sizes(FaultKind::collision, 3, {{0.0, 20.0}});
  expect_sizes(FaultKind::collision, 0, {{0.0, 10.0}, {0.0, 5.0}, {0.0, 20.0}});
  expect_sizes(FaultKind::unknown, 2, {{0.0, 5.0}});
}

TEST(WithSizes, TheHealthyStateStaysAndTheSizeIsIndependentOfIt) {
  for (const FaultKind kind : {FaultKind::friction_increase, FaultKind::unknown}) {
    const GaussianState state = with_sizes(healthy(), hypothesis_of(kind, 1), model().priors);
    EXPECT_EQ(mean_of(state).head(6), mean_of(healthy()));
    EXPECT_EQ(covariance_of(state).topLeftCorner(6, 6), covariance_of(healthy()));
    for (int i = 0; i < state.size; ++i)
      for (int s = 6; s < state.size; ++s) EXPECT_EQ(i == s ? 0.0 : state.p(i, s) + state.p(s, i), 0.0);
  }
}

/// The sizes after clamping `from`.
Sizes clamped(FaultKind kind, std::vector<double> from) {
  const Hypothesis hypothesis = hypothesis_of(kind, 3);
  GaussianState state = with_sizes(healthy(), hypothesis, model().priors);
  for (std::size_t s = 0; s < from.size(); ++s) state.mean[6 + s] = from[s];
  const GaussianState before = state;
  clamp_sizes(state, hypothesis, model());
  EXPECT_EQ(mean_of(state).head(6), mean_of(before).head(6));
  EXPECT_EQ(covariance_of(state), covariance_of(before));
  Sizes out;
  for (int s = 6; s < state.size; ++s) out.emplace_back(state.mean[s], 0.0);
  return out;
}

TEST(ClampSizes, ALossIsAShare) {
  EXPECT_EQ(clamped(FaultKind::torque_loss, {-0.2})[0].first, 0.0);
  EXPECT_EQ(clamped(FaultKind::torque_loss, {1.3})[0].first, 1.0);
  EXPECT_EQ(clamped(FaultKind::torque_loss, {0.4})[0].first, 0.4);
}

TEST(ClampSizes, FrictionOnlyRises) {
  EXPECT_EQ(clamped(FaultKind::friction_increase, {-1.0, 2.0}), (Sizes{{0.0, 0.0}, {2.0, 0.0}}));
  EXPECT_EQ(clamped(FaultKind::friction_increase, {1.0, -2.0}), (Sizes{{1.0, 0.0}, {0.0, 0.0}}));
  EXPECT_EQ(clamped(FaultKind::friction_increase, {50.0, 60.0}), (Sizes{{50.0, 0.0}, {60.0, 0.0}}));
}

TEST(ClampSizes, TheTipKeepsATenthOfWhatItCarries) {
  EXPECT_NEAR(clamped(FaultKind::payload_change, {-9.0})[0].first, -0.9 * 2.5, 1e-12);
  EXPECT_EQ(clamped(FaultKind::payload_change, {-2.0})[0].first, -2.0);
  EXPECT_EQ(clamped(FaultKind::payload_change, {9.0})[0].first, 9.0);
}

TEST(ClampSizes, OtherSizesAreFree) {
  for (const FaultKind kind :
       {FaultKind::sensor_bias, FaultKind::sensor_drift, FaultKind::collision, FaultKind::unknown})
    for (const double size : {-1e3, 1e3}) EXPECT_EQ(clamped(kind, {size})[0].first, size) << to_string(kind);
}

}  // namespace
}  // namespace faultline
