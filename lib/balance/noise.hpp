// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <limits>
#include <utility>
#include <vector>

#include "lib/balance/rows.hpp"

namespace faultline {

/// Variance of one joint's rows (equation (3) of docs/how-it-works.md): base + torque tau^2 + rest (1 -
/// tanh^2(dq / width)) + speed dq^2 + timing step^2 + others (sum of dq^2 of the other joints), where step^2
/// is BalanceRows::step_square: the error of torque steps that act a fraction of a sample earlier or later.
struct JointNoise {
  double base = 0.0, torque = 0.0, rest = 0.0, speed = 0.0, timing = 0.0, others = 0.0;
  Eigen::VectorXd filter;   ///< autoregression of the rows over their standard deviation: 1, -a1, -a2, ..
  double innovation = 1.0;  ///< standard deviation of the filtered rows

  bool operator==(const JointNoise&) const = default;
};

/// Noise of the torque-balance rows by joint, which whitens them.
struct RowNoise {
  std::vector<JointNoise> joint;

  bool operator==(const RowNoise&) const = default;
};

/// Standard deviation of a row without weight, such as one that was lost.
inline constexpr double kNoWeight = std::numeric_limits<double>::infinity();

/// Returns the standard deviation of each row (rows x joints) of a log whose white noise is `loudness` (by
/// joint) times that of the healthy logs; kNoWeight for lost rows and for joints at rest that stick.
Eigen::MatrixXd row_std(const BalanceRows& rows, const RowSetting& setting, const RowNoise& noise,
                        const Eigen::VectorXd& loudness);

/// Whitens the rows of one joint of a log (equation (4) of docs/how-it-works.md): divides them by their
/// standard deviation, subtracts the best linear prediction from the last rows that have weight, and divides
/// the rest by its standard deviation. As many rows predict a row as the autoregression has terms; the first
/// rows of a log have fewer before them, and those behind rows without weight are predicted less well.
class Whitener {
 public:
  Whitener(const Eigen::VectorXd& std, const JointNoise& noise);

  /// Returns whitened columns (rows x columns); rows without weight are 0.
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& columns) const { return of(columns, 0); }
  /// Returns the same for columns that are given from row `begin` on and are 0 before it.
  Eigen::MatrixXd of(const Eigen::MatrixXd& columns, Eigen::Index begin) const;

  /// Returns the first row at or after `row` whose whitened value contains no row before `row`; the number of
  /// rows if there is none.
  Eigen::Index reach(Eigen::Index row) const;

 private:
  /// A row that is not predicted from the rows right before it, or has no weight.
  struct Irregular {
    Eigen::Index row = 0;
    std::vector<std::pair<Eigen::Index, double>> predictors{};  ///< row and weight, over standard deviations
    double innovation = 1.0;
  };

  Eigen::VectorXd weight_;  ///< by row: one over the standard deviation
  Eigen::VectorXd filter_;
  double innovation_ = 1.0;
  std::vector<Irregular> irregular_;
};

/// Returns the whitener of each joint; `std`: rows x joints.
std::vector<Whitener> whiteners(const Eigen::MatrixXd& std, const RowNoise& noise);

/// Residuals of one healthy log and the rows that they belong to.
struct LogResidual {
  const BalanceRows* rows = nullptr;
  Eigen::MatrixXd torque;         ///< rows x joints
  Eigen::MatrixXd std;            ///< rows x joints, for with_filter()
  std::vector<bool> not_counted;  ///< by row: excluded, near a change of the work piece
};

/// Returns `noise` with the variances estimated by non-negative least squares of the squared innovations, of
/// which rare large ones are clipped: of what the filter that `noise` has for a joint does not predict from
/// the rows before (the residuals themselves without a filter). What wanders slowly is predicted, so that a
/// row is as loud as what is new in it; the variances are scaled to those of the residuals on average.
RowNoise with_variance(const std::vector<LogResidual>& logs, const RowSetting& setting, RowNoise noise);
/// Returns `noise` with the autoregression of order `order` of the residuals over their standard deviation
/// (Yule and Walker).
RowNoise with_filter(const std::vector<LogResidual>& logs, int order, RowNoise noise);

/// Returns the sums of products of rows that lie 0, 1, .. `order` apart.
Eigen::VectorXd lag_products(const Eigen::VectorXd& rows, Eigen::Index order);

/// Returns the autocovariance of rows over their standard deviation, of lag 0 up to the order of the filter,
/// by the equations of Yule and Walker.
Eigen::VectorXd autocovariance(const JointNoise& noise);
/// Returns the greatest ratio by which the evidence for a torque that lasts may exceed its score with white
/// noise: the greatest variance of a joint's noise over its spectral density at frequency zero; at least 1.
double most_hidden_by_white_noise(const RowNoise& noise);
/// Returns `noise` with the autoregression that has this autocovariance (Yule and Walker).
JointNoise with_autocovariance(JointNoise noise, Eigen::VectorXd covariance);

}  // namespace faultline
