// SPDX-License-Identifier: MIT
// Onsets of a drifting position, of a robot in closed form.
#include "lib/explain/search/search.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

using testing::fit_of;
using testing::of_day;
using testing::run_of;
using testing::simulate_closed_form;

constexpr double kOnset_s = 4.0, kDrift = 0.04;  // of joint 2, rad/s

/// A day on which the encoder of joint 2 drifts from the onset on, and its velocity with it.
Log with_drift() {
  Log log = simulate_closed_form(of_day(1), run_of(21));
  for (int k = 0; k < log.rows(); ++k)
    if (log.time[k] >= kOnset_s) {
      log.q[1][k] += kDrift * (log.time[k] - kOnset_s);
      log.dq[1][k] += kDrift;
    }
  return log;
}

const Candidate& best_of(const std::vector<Candidate>& all) {
  return *std::ranges::max_element(all, {}, &Candidate::score);
}

TEST(DriftSearch, TheBestOnsetIsThatOfTheDrift) {
  const LogFit fit = fit_of(with_drift());
  const std::vector<Candidate> found = search_drifts(white_search(fit));
  ASSERT_FALSE(found.empty());
  const Candidate& best = best_of(found);
  EXPECT_EQ(best.kind, FaultKind::sensor_drift);
  EXPECT_EQ(best.joint, 2_joint);
  EXPECT_NEAR(best.onset_s, kOnset_s, 0.05);
  EXPECT_DOUBLE_EQ(best.size[0], kDrift);
  EXPECT_GT(best.score, 30.0);
}

TEST(DriftSearch, AHealthyLogHasNoStrongOnset) {
  const LogFit fit = fit_of(simulate_closed_form(of_day(1), run_of(21)));
  EXPECT_LT(best_of(search_drifts(white_search(fit))).score, 10.0);
}

TEST(DriftSearch, SumsWithTheEffectsAreThoseOfTheRowsFromTheOnsetOn) {
  const LogFit fit = fit_of(with_drift());
  const WhiteSearch search = white_search(fit);
  const int rows = fit.count();
  Stacked column = Stacked::Zero(rows * fit.joints());
  for (int t = 0; t < rows; ++t) column[t] = 0.1 * t, column[2 * rows + t] = 1.0;  // of joints 1 and 3
  const Eigen::MatrixXd sums = effect_sums_from_each_row(search, column);
  for (const int onset : {0, rows / 3, rows - 1}) {
    Eigen::VectorXd direct = Eigen::VectorXd::Zero(sums.rows());
    for (const int j : {0, 2})
      for (int t = onset; t < rows; ++t)
        direct += search.effects[j].col(t) * search.weight[j * rows + t] * column[j * rows + t];
    EXPECT_LT((sums.col(onset) - direct).norm(), 1e-9 * (1.0 + direct.norm())) << onset;
  }
}

}  // namespace
}  // namespace faultline
