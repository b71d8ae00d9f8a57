// SPDX-License-Identifier: MIT
#include "lib/explain/least_found.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/explain/explain_log.hpp"
#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

using namespace testing;

constexpr double kMiddle_s = 4.0;

ExplainModel explained() { return {scara_model(), evidence_limits({})}; }

double least_of(const FaultLabel& label) {
  const UniformLog healthy = on_grid(simulate_closed_form(of_day(1), run_of(31)));
  const std::vector<LeastFound> least = least_found(healthy, explained(), {label});
  return least.empty() ? 0.0 : least.front().size;
}

/// Of ten healthy logs of other days, how many show a change that begins in the middle.
template <typename Change>
int found_of_ten(const Change& change) {
  int found = 0;
  for (int seed = 0; seed < 10; ++seed) {
    Log log = simulate_closed_form(of_day(seed), run_of(100 + seed));
    for (int k = 0; k < log.rows(); ++k)
      if (log.time[k] >= kMiddle_s) change(log, k);
    found += !explain_whole_log(on_grid(std::move(log)), explained()).faults.empty();
  }
  return found;
}

TEST(DetectableSize, ATorqueOffsetOfTwiceTheSizeIsFoundAndHalfTheSizeIsNot) {
  const double size = least_of({FaultKind::torque_sensor_error, 1_joint});
  const auto offset = [](double nm) { return [nm](Log& log, int k) { log.tau[0][k] += nm; }; };
  EXPECT_GE(found_of_ten(offset(2.0 * size)), 8);
  EXPECT_LE(found_of_ten(offset(0.5 * size)), 2);
}

TEST(DetectableSize, AShiftedPositionOfTwiceTheSizeIsFoundAndATenthIsNot) {
  const double size = least_of({FaultKind::sensor_bias, 2_joint});
  const auto shifted = [](double rad) { return [rad](Log& log, int k) { log.q[1][k] += rad; }; };
  EXPECT_GE(found_of_ten(shifted(2.0 * size)), 8);
  EXPECT_LE(found_of_ten(shifted(0.1 * size)), 2);
}

TEST(DetectableSize, AnOffsetWithoutACandidateIsFoundByItsExactEvidence) {
  // The noise of these rows hardly wanders, so that white noise hides an offset that lasts.
  const double size = least_of({FaultKind::torque_sensor_error, 1_joint});
  EXPECT_GE(found_of_ten([size](Log& log, int k) { log.tau[0][k] += 1.8 * size; }), 10);
}

TEST(DetectableSize, OfATorqueLossIsNotBelowTheGainOfAnotherDay) {
  EXPECT_GE(least_of({FaultKind::torque_loss, 1_joint}), kLeastLoss);
}

TEST(DetectableSize, IsZeroForAKindWithoutSize) { EXPECT_EQ(least_of({FaultKind::locked, 1_joint}), 0.0); }

TEST(DetectableSize, FollowsFromCovarianceAndPrior) {
  // A prior variance of 4 and rows that leave .01: the information is 100 - .25.
  const Eigen::MatrixXd covariance = Eigen::MatrixXd::Constant(1, 1, 0.01);
  const Eigen::VectorXd variance = Eigen::VectorXd::Constant(1, 4.0), one = Eigen::VectorXd::Ones(1);
  const double each = 99.75 * 0.01 * 99.75, price = 0.5 * std::log(400.0);
  EXPECT_NEAR(least_size_found(covariance, variance, one, 100.0),
              (1.2816 + std::sqrt(2.0 * (100.0 + price))) / std::sqrt(each), 1e-9);
  EXPECT_TRUE(std::isinf(least_size_found(variance.asDiagonal(), variance, one, 100.0)));
}

}  // namespace
}  // namespace faultline
