// SPDX-License-Identifier: MIT
#include "lib/diagnose/curves/window_curves.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace faultline {
namespace {

/// One joint, a sample a second, a healthy residual of 0.5 m and 0.25 m/s.
Model slide() {
  Model model;
  model.robot = preset_robot("P");
  model.residual.shape = {.joints = 1, .step_s = 1.0};
  model.residual.healthy.position_rms = Eigen::VectorXd::Constant(1, 0.5);
  model.residual.healthy.velocity_rms = Eigen::VectorXd::Constant(1, 0.25);
  return model;
}

Log rows(int count, double start_s = 0.0) {
  Log log;
  log.q.resize(1);
  log.dq.resize(1);
  log.tau.resize(1);
  for (int k = 0; k < count; ++k) {
    log.time.push_back(start_s + k);
    log.q[0].push_back(10.0 + k);
    log.dq[0].push_back(1.0);
    log.tau[0].push_back(-2.0);
  }
  return log;
}

/// Predictions that end in each of the rows but the first: 1 and 2 healthy residuals, 3 N too little.
Residuals residuals_of_rows(const Log& log) {
  const int count = log.rows() - 1;
  Residuals r;
  r.time = Eigen::VectorXd(count);
  for (int i = 0; i < count; ++i) {
    r.row.push_back(i + 1);
    r.time[i] = log.time[i + 1];
  }
  r.position = Eigen::MatrixXd::Constant(1, count, 1.0);
  r.velocity = Eigen::MatrixXd::Constant(1, count, -2.0);
  r.torque = Eigen::MatrixXd::Constant(1, count, 3.0);
  r.tau = Eigen::MatrixXd::Constant(1, count, -2.0);
  r.ratio = Eigen::MatrixXd::Zero(1, count);
  return r;
}

CurveWindow window(double start_s, double end_s, int bins) {
  CurveWindow made;
  made.start_s = start_s;
  made.end_s = end_s;
  made.bins = bins;
  return made;
}

TEST(WindowCurves, PredictedMotionEqualsTheMeasuredMotionMinusTheResidual) {
  const Model model = slide();
  const Log log = rows(9);
  WindowCurves curves(window(0.0, 8.0, 8), model, {});
  curves.take(log, residuals_of_rows(log), RequiredTorque::Constant(1, log.rows(), 1.0));
  const JointCurves joint = curves.curves().joints.at(0);
  ASSERT_EQ(joint.q.values.size(), 16u);
  EXPECT_EQ(joint.q.values[4], 12.0f);
  EXPECT_EQ(joint.q_predicted.values[4], 11.5f);
  EXPECT_EQ(joint.dq_predicted.values[4], 1.5f);
  EXPECT_EQ(joint.tau.values[4], -2.0f);
  EXPECT_EQ(joint.tau_required.values[4], 1.0f);
  EXPECT_EQ(joint.residual.at(2), 2.0f);
}

TEST(WindowCurves, RowsOutsideTheWindowAreIgnored) {
  const Model model = slide();
  const Log log = rows(9);
  WindowCurves curves(window(2.0, 4.0, 1), model, {});
  curves.take(log, residuals_of_rows(log), RequiredTorque::Constant(1, log.rows(), 1.0));
  const JointCurves joint = curves.curves().joints.at(0);
  EXPECT_EQ(joint.q.values, (std::vector<float>{12.0f, 14.0f}));
  EXPECT_EQ(joint.q_predicted.values, (std::vector<float>{11.5f, 13.5f}));
}

TEST(WindowCurves, APredictionFillsTheBinsSinceThePreviousOneButNoGap) {
  const Model model = slide();
  Log log = rows(9);
  for (int k = 5; k < 9; ++k) log.time[k] += 3.0;  // 4 s, then 8 s
  WindowCurves curves(window(0.0, 11.0, 22), model, {});
  curves.take(log, residuals_of_rows(log), RequiredTorque::Constant(1, log.rows(), 1.0));
  const std::vector<float> predicted = curves.curves().joints.at(0).q_predicted.values;
  for (const int bin : {3, 4, 5, 6, 7, 8, 17, 18}) EXPECT_TRUE(std::isfinite(predicted[2 * bin])) << bin;
  for (const int bin : {0, 1, 10, 12, 14}) EXPECT_TRUE(std::isnan(predicted[2 * bin])) << bin;
}

TEST(WindowCurves, ASignalThatTheLogDoesNotHaveIsEmpty) {
  const Model model = slide();
  Log log = rows(9);
  const Residuals residuals = residuals_of_rows(log);
  log.dq.clear();
  WindowCurves curves(window(0.0, 8.0, 4), model, {});
  curves.take(log, residuals, {});
  const JointCurves joint = curves.curves().joints.at(0);
  EXPECT_TRUE(joint.dq.values.empty());
  EXPECT_TRUE(joint.dq_predicted.values.empty());
  EXPECT_FALSE(joint.q_predicted.values.empty());
}

}  // namespace
}  // namespace faultline
