// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lib/core/random.hpp"
#include "lib/log/log.hpp"

namespace faultline {

/// Which rows of a log make one prediction: row k and row k + step, for every k that is a multiple of stride.
struct TransitionShape {
  int joints = 0;
  int step = 1;             ///< rows
  int stride = 1;           ///< rows; at most `step`, so that every row lies in some prediction
  double step_s = 0.0;      ///< nominal duration of `step` rows
  double torque_phi = 0.0;  ///< torque between rows k and k+1 is tau_k + phi (tau_k+1 - tau_k)
  bool derive_velocity =
      false;  ///< the logs have no dq: the mean velocity over the `step` rows before is used
};

/// Pairs of rows, a pair a column; joints x pairs.
struct Transitions {
  std::vector<std::int64_t> row;  ///< of the later row, counted from the log's first row handed out
  Eigen::VectorXd time;           ///< of the later row, s
  Eigen::VectorXd duration;    ///< s; NaN when it differs from the nominal one by a quarter (gap in the log)
  Eigen::MatrixXd q, dq, tau;  ///< at the earlier row
  Eigen::MatrixXd mean_tau;    ///< over the pair's duration
  Eigen::MatrixXd next_q, next_dq;

  int count() const { return static_cast<int>(row.size()); }
};

/// Calls visit(mine, theirs) for each pair of matrices of joints x pairs.
template <typename Visit>
void for_each_matrix(Transitions& mine, const Transitions& theirs, Visit visit) {
  visit(mine.q, theirs.q);
  visit(mine.dq, theirs.dq);
  visit(mine.tau, theirs.tau);
  visit(mine.mean_tau, theirs.mean_tau);
  visit(mine.next_q, theirs.next_q);
  visit(mine.next_dq, theirs.next_dq);
}

/// What is carried over a segment border: the last rows.
struct TransitionState {
  Log tail;
  std::int64_t rows_seen = 0;
};

/// Returns all pairs whose later row lies in `segment`. Throws Error(input) when a channel is missing or the
/// joints are not those of the shape.
Transitions collect_transitions(const Log& segment, const TransitionShape& shape, TransitionState& state);

/// Returns the columns of `first`, then those of `second`.
Transitions joined(const Transitions& first, const Transitions& second);

/// At most `capacity` transitions drawn at random, each with the same chance, from a stream of any length
/// (reservoir sampling, Vitter 1985).
class TransitionReservoir {
 public:
  TransitionReservoir(int capacity, std::uint64_t seed) : capacity_(capacity), random_(seed) {}

  void offer(const Transitions& transitions, int column);
  Transitions drawn() const;
  std::int64_t offered() const { return offered_; }

 private:
  int capacity_;
  Random random_;
  std::int64_t offered_ = 0;
  int kept_ = 0;
  Transitions pool_;
};

}  // namespace faultline
