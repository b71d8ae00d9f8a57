// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace faultline {

/// Weights of a Gaussian kernel of standard deviation `sigma_s`, cut at four of them, with sum one. Their
/// number is odd; sigma 0 gives the single weight 1.
Eigen::VectorXd gaussian_kernel(double sigma_s, double period_s);

/// Each column smoothed by a symmetric kernel; beyond the ends the first and last value are repeated.
Eigen::MatrixXd smooth(const Eigen::MatrixXd& values, const Eigen::VectorXd& kernel);

/// The same at the rows first, first + step, .. alone, `count` of them; the kernel must lie within the rows.
Eigen::MatrixXd smooth_at(const Eigen::MatrixXd& values, const Eigen::VectorXd& kernel, int first, int step,
                          int count);

/// Derivative by central differences, one-sided at the ends.
Eigen::VectorXd gradient(const Eigen::VectorXd& values, double period_s);

/// Two-sided exponential average sum_k decay^|k| x, zero phase, unit gain. Beyond both ends stands the mean
/// of the values within 1 / (1 - decay) of them.
Eigen::VectorXd two_sided_exponential(const Eigen::VectorXd& values, double decay);

/// Normal distribution function, to 2e-9.
double normal_cdf(double x);

}  // namespace faultline
