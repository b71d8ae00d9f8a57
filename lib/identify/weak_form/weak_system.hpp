// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/identify/weak_form/weak_windows.hpp"

namespace faultline {

/// Which windows, which torque and which friction width each joint's balance is made of.
struct WeakChoice {
  std::vector<int> set;        ///< by joint: index of its window length
  std::vector<int> shift;      ///< by joint: samples by which its torque acts later than logged
  std::vector<int> width;      ///< by joint: index of its friction width
  std::vector<int> bend;       ///< by joint: index of the width of its bent friction
  std::vector<double> gain{};  ///< by joint: true torque of each one logged; empty: all 1
};

/// The chosen balances as one system in the linear parameters of the space, joint after joint.
struct WeakSystem {
  Eigen::MatrixXd a;
  Eigen::VectorXd y;
  Eigen::VectorXd use;     ///< 1, or 0 for rows to leave out: the joint rests
  std::vector<int> joint;  ///< of each row, from 0
  std::vector<int> log;    ///< of each row
  std::vector<int> block;  ///< of each row: the same second of the same log
  int blocks = 0;
  int joints = 0;
  Eigen::VectorXd width;  ///< ln of the friction widths chosen
};

WeakSystem assemble(const WeakSets& windows, const WeakChoice& choice);

/// Whether joint `j` moves in a window of that set enough for its friction to be told from stiction; by
/// window.
std::vector<bool> moving_windows(const WeakSets& windows, int set, int joint);

}  // namespace faultline
