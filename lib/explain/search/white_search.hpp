// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/explain/hypothesis.hpp"

namespace faultline {

inline constexpr double kLead_s = 0.5;  ///< at the start of a log, in which no onset is looked for
inline constexpr int kTail = 2;         ///< rows at the end in which none is looked for

/// An onset worth judging for one kind and joint.
struct Candidate {
  FaultKind kind = FaultKind::none;
  int joint = 0;  ///< from 1
  double onset_s = 0.0;
  double score = 0.0;  ///< nats under white noise: for the choice of onsets only
  double start = 0.0;  ///< size of a sensor fault to begin with
  double end_s = kNeverEnds;
};

/// What the search keeps of the healthy explanation: white noise of the healthy size. A hard edge of an onset
/// would be blown up by the whitening.
struct WhiteSearch {
  const LogFit& fit;
  Stacked weight;                        ///< 1 over the variance of each row
  std::vector<Eigen::MatrixXd> effects;  ///< by joint, effects x rows: columns whose sizes have unit variance
  Stacked left;                          ///< torque left over, effects taken away

  /// Torque of joint `joint` (from 0) left over, times its weight in each row.
  Eigen::VectorXd weighted(int joint) const;
};

WhiteSearch white_search(const LogFit& fit);

/// Sums of the weighted products of a stacked column with another one, and with each effect (effects x rows),
/// over each row and all later ones of all joints.
Eigen::VectorXd sums_from_each_row(const WhiteSearch& search, const Eigen::Ref<const Stacked>& column,
                                   const Eigen::Ref<const Stacked>& other);
Eigen::MatrixXd effect_sums_from_each_row(const WhiteSearch& search, const Eigen::Ref<const Stacked>& column);

/// Such sums, each a row over the onsets, over `length` rows from each row on (0: to the end).
Eigen::MatrixXd over_rows(const Eigen::MatrixXd& sums_from_each_row, int length);

/// Evidence for columns that are switched on at each row for `length` rows (0: to the end), from cumulative
/// normal equations (equation (10) of docs/how-it-works.md): nats by row, one vector for each length.
std::vector<Eigen::VectorXd> onset_gains(const WhiteSearch& search, const FaultColumns& columns,
                                         const std::vector<int>& lengths);

/// The `most` highest scores that lie apart, among the rows that may hold an onset; each is the given
/// candidate at its time.
std::vector<Candidate> peaks(const LogFit& fit, Candidate candidate, Eigen::VectorXd score, int most);

}  // namespace faultline
