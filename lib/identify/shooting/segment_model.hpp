// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "lib/identify/motion/stretch.hpp"
#include "lib/identify/parameter_space.hpp"
#include "lib/robot/fast_dynamics.hpp"

namespace faultline {

/// Motion of a robot with given parameters from a given state, and its derivatives by both.
struct SegmentMotion {
  Eigen::MatrixXd state;  ///< 2 joints x rows: q over dq
  Eigen::MatrixXd
      sensitivity;  ///< (2 joints rows) x (2 joints + free): of every state to start and parameters
};

/// Integrates (Runge and Kutta, fourth order) the forward dynamics over an excerpt, with torque tau_k + phi
/// (tau_k+1 - tau_k) over sample k, together with the variational equations. One set of parameters; run() may
/// be called from any number of threads.
class SegmentModel {
 public:
  /// `free` lists the parameters of the sensitivities. No step is longer than 10 ms, or than `longest_step_s`
  /// if some joint is so slow that its Coulomb friction changes.
  SegmentModel(const ParameterSpace& space, const Eigen::VectorXd& parameters, const std::vector<int>& free,
               double longest_step_s);

  void run(const Excerpt& excerpt, const Eigen::VectorXd& start, bool with_sensitivity,
           SegmentMotion& motion) const;

 private:
  struct Workspace;
  int steps(const Excerpt& excerpt, int row) const;
  void accelerate(const JointVector& tau, Workspace& w) const;
  void add_extra_slopes(Workspace& w) const;
  void pass_torque(Workspace& w) const;
  void slopes_by_state(Workspace& w) const;
  void base_slope(std::size_t direction, const Workspace& w, Eigen::Ref<Eigen::VectorXd> slope) const;
  void slopes_by_parameter(const JointVector& tau_step, Workspace& w) const;
  void carry_sensitivity(double h, Workspace& w) const;
  void step(double h, const JointVector& tau, const JointVector& tau_step, bool with_sensitivity,
            Workspace& w) const;

  const ParameterSpace& space_;
  Eigen::VectorXd parameters_;
  std::vector<int> free_;
  double longest_step_s_;
  FastDynamics dynamics_;
  std::vector<FastDynamics> directions_;             ///< each free base parameter alone; for parallel axes
  std::vector<Eigen::SparseVector<double>> shares_;  ///< its inertial numbers; for other chains
};

}  // namespace faultline
