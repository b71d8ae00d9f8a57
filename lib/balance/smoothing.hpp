// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace faultline {

/// Returns the weights of a Gaussian kernel of standard deviation `sigma_s`, cut at four of them, with sum
/// one. Their number is odd; sigma 0 gives the single weight 1.
Eigen::VectorXd gaussian_kernel(double sigma_s, double period_s);

/// Smooths each column by a symmetric kernel; beyond the ends the first and last value are repeated.
Eigen::MatrixXd smooth(const Eigen::MatrixXd& values, const Eigen::VectorXd& kernel);

/// Does the same at `count` rows first, first + step, .. alone; the kernel must lie within the rows.
Eigen::MatrixXd smooth_at(const Eigen::MatrixXd& values, const Eigen::VectorXd& kernel, int first, int step,
                          int count);

/// Returns the derivative by central differences, one-sided at the ends.
Eigen::VectorXd gradient(const Eigen::VectorXd& values, double period_s);

/// Returns the two-sided exponential average sum_k decay^|k| x, with zero phase and unit gain. Beyond each
/// end it takes the mean of the values within 1 / (1 - decay) samples of the end.
Eigen::VectorXd two_sided_exponential(const Eigen::VectorXd& values, double decay);

/// Normal distribution function, to 2e-9.
double normal_cdf(double x);

/// Returns the density at `x` of a normal distribution of mean 0.
double normal_density(double x, double std);

}  // namespace faultline
