// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lib/identify/identification.hpp"

namespace faultline {

/// Masses and lengths of the links, as far as base parameters and the robot file's facts determine them.
struct PhysicalFit {
  std::vector<ParameterEstimate> parameters;  ///< m1.., then l1..; NaN if not identifiable
  /// Contradiction of base parameters and facts, in standard errors, if they exceed masses and lengths in
  /// number; about 1 if the links are as assumed. Intervals are widened by it.
  double contradiction = 1.0;
  std::vector<std::string> hardly_identifiable;  ///< names of those whose interval would reach zero
  /// Of all links. If one is neither known nor identified, a guess from positive masses: of a SCARA whose l1
  /// is known, b / c bounds l2 to +-20 %.
  std::vector<double> lengths;
  std::vector<std::string> guessed_lengths;  ///< names of the guessed ones, such as "l2 (some 0.25 m)"
};

/// Base parameters from logs with the same payload.
struct BaseEstimate {
  Eigen::VectorXd estimate;    ///< all parameters of the space
  Eigen::MatrixXd covariance;  ///< of `estimate`
  std::vector<bool> usable;    ///< by base parameter: the logs determine it
  KnownValue payload;          ///< kg at the tip; 0 for the robot itself
};

/// Solves the base parameters (weighted by their covariance) and the facts in robot.known for the masses and
/// lengths of rods and points. The first of `estimates` is the robot without payload; others add their
/// payload. Unknowns that are not determined name the missing facts.
PhysicalFit physical_parameters(const Robot& robot, const ParameterSpace& space,
                                std::span<const BaseEstimate> estimates);

}  // namespace faultline
