// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/balance/rows.hpp"

namespace faultline {

/// Variance of one joint's rows (equation (3) of docs/how-it-works.md): base + torque tau^2 + rest (1 -
/// tanh^2(dq / width)) + speed dq^2 + timing step^2, where step^2 is the square of the torque's steps within
/// the kernel: what a step that acts a share of a sample earlier or later leaves.
struct JointNoise {
  double base = 0.0, torque = 0.0, rest = 0.0, speed = 0.0, timing = 0.0;
  Eigen::VectorXd filter;   ///< autoregression of the rows over their standard deviation: 1, -a1, -a2, ..
  double innovation = 1.0;  ///< standard deviation behind the filter

  bool operator==(const JointNoise&) const = default;
};

/// What makes rows of unit variance without correlation out of torque-balance rows.
struct RowNoise {
  std::vector<JointNoise> joint;

  bool operator==(const RowNoise&) const = default;
};

/// Standard deviation of each row (rows x joints) of a log whose white noise is `loudness` times that of the
/// healthy logs, by joint. Lost rows have one that makes them count for nothing.
Eigen::MatrixXd row_std(const BalanceRows& rows, const RowSetting& setting, const RowNoise& noise,
                        const Eigen::VectorXd& loudness);

/// Rows of several columns as white rows of unit variance (equation (4) of docs/how-it-works.md): divided by
/// their standard deviation, then filtered. `columns` are of one joint.
Eigen::MatrixXd whiten(const Eigen::MatrixXd& columns, const Eigen::VectorXd& std, const JointNoise& noise);

/// What healthy logs left unexplained, with the rows it was left in.
struct LeftOver {
  const BalanceRows* rows = nullptr;
  Eigen::MatrixXd torque;         ///< rows x joints
  Eigen::MatrixXd std;            ///< rows x joints, for with_filter()
  std::vector<bool> not_counted;  ///< by row: near a change of the work piece
};

/// The variance of rows as non-negative least squares of the squared residuals, these cut where they are
/// rare.
RowNoise with_variance(const std::vector<LeftOver>& logs, const RowSetting& setting, RowNoise noise);
/// Autoregression of order `order` of the residuals over their standard deviation (Yule and Walker).
RowNoise with_filter(const std::vector<LeftOver>& logs, int order, RowNoise noise);

/// Autocovariance of rows over their standard deviation: of lag 0 up to the order of the filter.
Eigen::VectorXd autocovariance(const JointNoise& noise);
/// By how much the evidence for a torque that lasts may exceed its score with white noise: the greatest
/// variance of a joint's noise over its spectral density at frequency zero; at least 1.
double most_hidden_by_white_noise(const RowNoise& noise);
/// The noise with the autoregression that has this autocovariance (Yule and Walker).
JointNoise with_autocovariance(JointNoise noise, Eigen::VectorXd covariance);

}  // namespace faultline
