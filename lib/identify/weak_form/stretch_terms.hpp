// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/identify/motion/stretch.hpp"
#include "lib/identify/parameter_space.hpp"

namespace faultline {

/// Friction widths of the weak form: multiples of the robot's, from sharp to smooth. The widest serve bent
/// friction alone.
inline constexpr int kWidths = 12;
inline constexpr int kCoulombWidths = 9;  ///< of Coulomb friction: the first, up to 10 times the robot's own
inline constexpr int kOwnWidth = 4;       ///< the robot's own
double weak_width(const ParameterSpace& space, int joint, int k);

/// Setting for the columns of extra terms: properties of the robot that are known before they are fitted.
struct ExtraSetting {
  std::vector<int> shift;      ///< by joint: samples by which its torque acts later than logged; empty: 0
  double phi = 0.5;            ///< of the torque between samples
  Eigen::VectorXd parameters;  ///< of the space, whatever its extra terms; empty: those of its chain
};

/// Contribution of every sample of a stretch to the momentum balance of a window that holds it, one column a
/// sample (from row k to row k + 1), joint after joint within a group of rows.
struct StretchTerms {
  Eigen::MatrixXd base;  ///< (base parameters x joints) rows, base after base: p_k+1 - p_k - dt (dT/dq - G)
  Eigen::MatrixXd viscous;  ///< joints rows: q_k+1 - q_k
  Eigen::MatrixXd coulomb;  ///< (kWidths x joints) rows: integral of tanh(dq / width)
  Eigen::MatrixXd skew;     ///< joints rows: integral of |dq|
  Eigen::MatrixXd rotor;    ///< joints rows: momentum of rotors that are no base parameter
  Eigen::MatrixXd extra;    ///< (extra terms x joints) rows
  Eigen::VectorXd step_s;   ///< duration
};

StretchTerms stretch_terms(const ParameterSpace& space, const Stretch& stretch,
                           const ExtraSetting& setting = {});

}  // namespace faultline
