// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lib/balance/one_step/innovations.hpp"
#include "lib/balance/one_step/linear_steps.hpp"
#include "lib/balance/regressor.hpp"
#include "lib/balance/rows.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kPeriod_s = 0.073;
constexpr double kSlopeWithin = 0.01;  // of a slope, where friction changes its sign within two substeps

/// Two links in a vertical plane; the base parameters are the mass numbers of the links themselves.
MotionBody planar_arm() {
  const Robot robot = preset_robot("RR");
  RigidColumns rigid{robot.chain, MatrixXd::Zero(2 * (kLinkParameters + 1), 2)};
  rigid.chain.gravity = Eigen::Vector3d(9.81, 0.0, 0.0);
  for (int i = 0; i < 2; ++i)
    rigid.lift.col(i).segment<kLinkParameters>(i * kLinkParameters) = to_vector(robot.chain.links[i]);
  return MotionBody(rigid, VectorXd::Constant(2, 0.2));
}

VectorXd numbers_of(const MotionBody& body) {
  const MotionLayout at = body.layout();
  VectorXd out = VectorXd::Zero(at.count());
  out.head(at.base) << 1.0, 0.8;
  out.segment(at.viscous(0), 2) << 0.3, 0.2;
  out.segment(at.coulomb(0), 2) << 0.4, 0.1;
  out.segment(at.gain(0), 2).setOnes();
  return out;
}

UniformLog driven_log(int samples) {
  UniformLog log;
  log.period_s = kPeriod_s;
  log.q = log.dq = log.tau = MatrixXd::Zero(samples, 2);
  log.lost.assign(samples, false);
  for (int k = 0; k < samples; ++k) log.tau.row(k) << 4.0 * std::sin(0.31 * k), 2.0 * std::cos(0.47 * k);
  return log;
}

TEST(OneStep, AccelerationWithSlopesEqualsAccelerationAloneAlsoWithRipple) {
  MotionBody smooth = planar_arm();
  RigidColumns rigid = smooth.rigid();
  rigid.chain.ripples = {{.joint = 2_joint, .rate = 12.0, .cosine = 0.5, .sine = 0.3}};
  for (const MotionBody& body : {smooth, MotionBody(rigid, VectorXd::Constant(2, 0.2))}) {
    const MotionLaw law(body, numbers_of(body));
    const JointVector q = Eigen::Vector2d(0.3, -0.5), dq = Eigen::Vector2d(0.9, -1.1),
                      tau = Eigen::Vector2d(2.0, 1.0);
    JointVector alone, beside;
    law.acceleration(q, dq, tau, alone);
    MotionSlopes slopes;
    law.acceleration_and_slopes(q, dq, tau, beside, slopes);
    EXPECT_LT((alone - beside).norm(), 1e-12 * alone.norm());
  }
}

TEST(OneStep, SlopesEqualFiniteDifferences) {
  const MotionBody body = planar_arm();
  const VectorXd numbers = numbers_of(body);
  const UniformLog log = driven_log(3);
  const StepSetting setting{kPeriod_s, false, 0.01};
  Trajectory about(4, 3);
  about << 0.3, 0.35, 0.4, -0.5, -0.4, -0.3, 0.9, 0.8, 0.7, -1.1, -1.2, -1.0;
  const double onset = 1.4 * kPeriod_s;
  VectorXd changed = numbers;
  changed[body.layout().gain(1)] = 0.6;
  const auto state_after = [&](const VectorXd& usual, const VectorXd& other, const Trajectory& from, int k) {
    const MotionLaw a(body, usual), b(body, other);
    return next_state(log, k, from, setting, {&a, &b, onset, 1e300});
  };
  const MotionLaw a(body, numbers), b(body, changed);
  const LinearSteps steps = linear_steps(log, about, setting, {&a, &b, onset, 1e300});
  for (int k = 0; k < 2; ++k) {
    const VectorXd next = state_after(numbers, changed, about, k);
    EXPECT_LT((steps.miss.col(k) - (next - about.col(k + 1))).norm(), 1e-12);
    for (int i = 0; i < 4; ++i) {
      Trajectory nudged = about;
      nudged(i, k) += 1e-6;
      const VectorXd slope = (state_after(numbers, changed, nudged, k) - next) / 1e-6;
      EXPECT_LT((slope - steps.slope_of(k).col(i)).norm(), kSlopeWithin * (1.0 + slope.norm()))
          << k << " " << i;
    }
    for (int p = 0; p < numbers.size(); ++p) {
      const VectorXd step = 1e-6 * VectorXd::Unit(numbers.size(), p);
      const VectorXd both = (state_after(numbers + step, changed + step, about, k) - next) / 1e-6;
      EXPECT_LT((both - steps.number_of(k).col(p)).norm(), kSlopeWithin * (1.0 + both.norm()))
          << k << " " << p;
      const VectorXd other = (state_after(numbers, changed + step, about, k) - next) / 1e-6;
      const VectorXd linear = steps.columns(MatrixXd(numbers.size(), 0), MatrixXd(step / 1e-6)).col(k);
      EXPECT_LT((other - linear).norm(), kSlopeWithin * (1.0 + other.norm())) << k << " " << p;
    }
  }
}

/// A robot that unknown forces push, read with noise: what the filter is made for.
TEST(OneStep, InnovationsAreWhiteAndErrorsOfTheSmootherMatchItsVariance) {
  const MotionBody body = planar_arm();
  const VectorXd numbers = numbers_of(body);
  const MotionLaw law(body, numbers);
  const int samples = 1500;
  const UniformLog log = driven_log(samples);
  const StepSetting setting{kPeriod_s, true, 0.02};
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  MatrixXd force(2, samples - 1);
  for (double& f : force.reshaped()) f = 0.05 * normal(random);
  Trajectory truth = Trajectory::Zero(4, samples), read(4, samples);
  for (int k = 0; k + 1 < samples; ++k)
    truth.col(k + 1) = next_state(log, k, truth, setting, {.usual = &law, .force = &force});
  const Eigen::Vector4d std(2e-3, 2e-3, 1e-2, 1e-2);
  for (int k = 0; k < samples; ++k)
    for (int i = 0; i < 4; ++i) read(i, k) = truth(i, k) + std[i] * normal(random);
  const LinearSteps steps = linear_steps(log, truth, setting, {.usual = &law});
  FilterInput in;
  in.column.resize(4, 0);
  in.process = process_covariance(steps, body.layout(), MatrixXd::Constant(2, samples - 1, 0.05));
  in.reading = read - truth;
  in.variance = std.cwiseAbs2().replicate(1, samples);
  const Innovations filter = innovations(steps, in);
  const VectorXd white = filter.white.col(0).tail(4 * (samples - 20));
  const double count = static_cast<double>(white.size());
  EXPECT_NEAR(white.squaredNorm() / count, 1.0, 4.0 * std::sqrt(2.0 / count));
  for (const int lag : {1, 2, 4, 8})
    EXPECT_NEAR(white.head(white.size() - lag).dot(white.tail(white.size() - lag)) / count, 0.0,
                4.0 / std::sqrt(count))
        << lag;
  MatrixXd variance;
  const Trajectory off = smoothed(steps, filter, VectorXd(0), &variance);  // truth is the zero here
  EXPECT_NEAR((off.cwiseAbs2().cwiseQuotient(variance)).mean(), 1.0, 0.1);
  EXPECT_LT(off.squaredNorm(), 0.5 * (read - truth).squaredNorm());
}

}  // namespace
}  // namespace faultline
