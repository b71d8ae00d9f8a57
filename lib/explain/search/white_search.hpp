// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/explain/hypothesis.hpp"

namespace faultline {

inline constexpr int kTail = 2;  ///< rows at the end, in which none is searched

/// Returns the first row at which an onset is searched. A push may begin before the log, since the rows after
/// it give the effects of the day.
int first_onset_row(const LogFit& fit, FaultKind kind);

/// A claim to judge; its size, if any, is the initial one of a sensor fault.
struct Candidate : FaultClaim {
  double score = 0.0;  ///< nats under white noise: only for the choice of onsets
};

/// Healthy explanation for the search, with white noise of the variance of the rows: whitening would amplify
/// the hard edge of an onset.
struct WhiteSearch {
  const LogFit& fit;
  Stacked weight;                        ///< 1 over the variance of each row
  std::vector<Eigen::MatrixXd> effects;  ///< by joint, effects x rows: columns whose sizes have unit variance
  Stacked left;                          ///< residual torque, the effects subtracted
};

WhiteSearch white_search(const LogFit& fit);

/// Returns the sums of the weighted products of a stacked column with another one, or with each effect
/// (effects x rows), over each row and all later ones of all joints.
Eigen::VectorXd sums_from_each_row(const WhiteSearch& search, const Eigen::Ref<const Stacked>& column,
                                   const Eigen::Ref<const Stacked>& other);
Eigen::MatrixXd effect_sums_from_each_row(const WhiteSearch& search, const Eigen::Ref<const Stacked>& column);

/// Returns such sums, each a row over the onsets, over `length` rows from each row on (0: to the end).
Eigen::MatrixXd over_rows(const Eigen::MatrixXd& sums_from_each_row, int length);

/// Returns the evidence for columns that are switched on at each row for `length` rows (0: to the end), from
/// cumulative normal equations (equation (10) of docs/how-it-works.md): nats by row, one vector for each
/// length.
std::vector<Eigen::VectorXd> onset_gains(const WhiteSearch& search, const FaultColumns& columns,
                                         const std::vector<int>& lengths);

/// Returns the `most` highest scores that lie apart, among the rows that may hold an onset: each is `claim`
/// with its onset and score.
std::vector<Candidate> peaks(const LogFit& fit, const FaultClaim& claim, Eigen::VectorXd score, int most);

}  // namespace faultline
