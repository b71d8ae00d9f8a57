// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lib/core/joint.hpp"

namespace faultline {

struct JointFit;
struct TorqueFit;

/// Motion of one joint in the logs.
struct JointExcitation {
  double q_low = 0.0, q_high = 0.0;  ///< range of position, rad or m
  double fastest_forward = 0.0;      ///< largest dq, rad/s or m/s
  double fastest_back = 0.0;         ///< largest -dq
  double forward = 0.0;              ///< share of the moving windows with dq > 0; NaN if it never moves
  std::string lacks;                 ///< what its motion lacks, in words; empty if nothing
};

/// How well the motion determines one parameter apart from all others.
struct ParameterExcitation {
  std::string name;
  double own = 0.0;  ///< share of its column that no mixture of the others explains: 1 is independent, 0 is
                     ///< not identifiable; NaN if the logs do not excite it
  std::string mixed_with;  ///< the parameter that it is hardest to separate from; empty if there is none
};

/// What the motion of the logs determines, independent of the torques.
struct Excitation {
  std::vector<JointExcitation> joints;
  std::vector<ParameterExcitation> parameters;  ///< base parameters (rotors only if fitted), fv_j, fc_j
  /// The least determined combination of parameters: name and weight, largest 1, weights below 0.1 omitted.
  std::vector<std::pair<std::string, double>> weakest;

  std::vector<int> columns;     ///< indices of `parameters` in the parameter space; not kept in JSON
  Eigen::VectorXd joint_scale;  ///< torque scale by joint, N m or N; not kept in JSON
  Eigen::MatrixXd moments;      ///< mean of a^T a over rows a / joint_scale of `columns`; not kept in JSON
};

/// Returns what the motion of the logs determines, by joint and by parameter. `still` are the joints that
/// never move; `fits` and `residual_rms` are by joint, of the same windows as `torque`.
Excitation motion_excitation(const TorqueFit& torque, const std::vector<JointFit>& fits,
                             const std::vector<double>& residual_rms, const std::vector<Joint>& still);

}  // namespace faultline
