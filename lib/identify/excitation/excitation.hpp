// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace faultline {

/// How one joint moved in the logs.
struct JointExcitation {
  double q_low = 0.0, q_high = 0.0;  ///< range of position, rad or m
  double fastest_forward = 0.0;      ///< largest dq, rad/s or m/s
  double fastest_back = 0.0;         ///< largest -dq
  double forward = 0.0;              ///< share of the moving windows with dq > 0; NaN when it never moves
  std::string lacks;                 ///< what its motion lacks, in words; empty: nothing
};

/// How well the motion tells one parameter from all others.
struct ParameterExcitation {
  std::string name;
  double own = 0.0;  ///< share of its column that no mixture of the others makes up: 1 stands alone, 0 is not
                     ///< told; NaN where the logs do not show it at all
  std::string mixed_with;  ///< the parameter it is hardest to separate from; empty when there is none
};

/// What the motion of the logs tells, whatever the torques were.
struct Excitation {
  std::vector<JointExcitation> joints;
  std::vector<ParameterExcitation> parameters;  ///< base parameters but rotors that do not pay, fv_j, fc_j
  /// The mixture that is determined least: weight by parameter, largest 1, those below a tenth left out.
  std::vector<std::pair<std::string, double>> weakest;

  std::vector<int> columns;     ///< of the parameter space, those of `parameters`; not kept in JSON
  Eigen::VectorXd joint_scale;  ///< torque that counts as one, by joint, N m or N; not kept in JSON
  Eigen::MatrixXd moments;  ///< mean of a^T a over the rows a / joint_scale of `columns`; not kept in JSON
};

}  // namespace faultline
