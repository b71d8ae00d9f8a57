// SPDX-License-Identifier: MIT
// A torque of one joint that begins at a known time, twice as large as the noise of its rows.
#include "lib/explain/free_form.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/balance/noise.hpp"
#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

using testing::ClosedFormScara;
using testing::fit_of;
using testing::run_of;
using testing::simulate_closed_form;

constexpr double kBegins_s = 5.0;
constexpr int kJoint = 1;

/// A healthy log with a torque of 7 Hz at one joint from kBegins_s on.
LogFit fit_with_torque(double amplitude) {
  Log log = simulate_closed_form(ClosedFormScara{}, run_of(21));
  for (int k = 0; k < log.rows(); ++k)
    if (log.time[k] > kBegins_s) log.tau[kJoint][k] += amplitude * std::sin(44.0 * log.time[k]);
  return fit_of(std::move(log));
}

/// Of the rows after kBegins_s, in standard deviations of the noise.
double rms_after(const LogFit& fit) {
  double sum = 0.0, count = 0.0;
  for (int k = 0; k < fit.count(); ++k)
    if (fit.time_s()[k] > kBegins_s + 0.1)
      sum += std::pow(fit.healthy().left[kJoint * fit.count() + k], 2), count += 1.0;
  return std::sqrt(sum / count);
}

TEST(FirstChange, IsTheTimeFromWhichOneJointIsUnexplained) {
  const LogFit fit = fit_with_torque(0.07);
  EXPECT_GT(rms_after(fit), 1.8);
  EXPECT_LT(rms_after(fit), 2.6);
  EXPECT_NEAR(first_change(fit).onset_s, kBegins_s, 0.2);
  EXPECT_GT(free_form(fit).onset_s, kBegins_s + 1.0);
}

TEST(FirstChange, IsTheTimeFromWhichOtherFrictionExplainsAJoint) {
  Log log = simulate_closed_form(ClosedFormScara{}, run_of(21));
  for (int k = 0; k < log.rows(); ++k)
    if (log.time[k] > kBegins_s) log.tau[kJoint][k] += 0.05 * std::tanh(log.dq[kJoint][k] / 0.05);
  const LogFit fit = fit_of(std::move(log));
  EXPECT_LT(rms_after(fit), 1.7);  // less than rows without explanation cost
  EXPECT_NEAR(first_change(fit).onset_s, kBegins_s, 0.3);
}

TEST(FirstChange, IsTheEndOfAHealthyLog) {
  const LogFit fit = fit_of(simulate_closed_form(ClosedFormScara{}, run_of(21)));
  EXPECT_GT(first_change(fit).onset_s, 7.0);
}

TEST(NoiseOfALog, ExcludesAFaultOfOneJoint) {
  const LogFit healthy = fit_with_torque(0.0), faulty = fit_with_torque(0.09);
  const double usual = autocovariance(healthy.noise().joint[kJoint])[0];
  EXPECT_LT(autocovariance(faulty.noise().joint[kJoint])[0], 1.2 * usual);
}

}  // namespace
}  // namespace faultline
