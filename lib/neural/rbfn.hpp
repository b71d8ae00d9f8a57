// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lib/neural/patterns.hpp"
#include "lib/neural/self_organising_map.hpp"

namespace faultline {

/// Radial basis function network of Cauchy units: unit u gives 1 / (1 + ||R_u^-1 (x - mu_u)||^2), R_u
/// diagonal; the output is a weighted sum of the units and a bias.
struct Rbfn {
  Eigen::MatrixXd centres;        ///< mu, inputs x units
  Eigen::MatrixXd inverse_radii;  ///< diagonal of R^-1, inputs x units
  Eigen::MatrixXd weights;        ///< outputs x units
  Eigen::VectorXd bias;           ///< outputs

  int inputs() const { return static_cast<int>(centres.rows()); }
  int units() const { return static_cast<int>(centres.cols()); }
  int outputs() const { return static_cast<int>(bias.size()); }
};

/// Outputs x samples for inputs x samples; a sample's result does not depend on the others, NaN stays NaN.
Eigen::MatrixXd forward(const Rbfn& rbfn, const Eigen::Ref<const Eigen::MatrixXd>& inputs);
double mean_squared_error(const Rbfn& rbfn, const Patterns& patterns);

enum class RadiusKind {
  per_unit,  ///< from the spread of the patterns near each unit
  global,    ///< one radius an input: the rms distance of the patterns to their nearest unit
};

struct RbfnOptions {
  SomOptions map = {};  ///< rows * columns units; units that no pattern is nearest to are left out
  RadiusKind radius = RadiusKind::per_unit;
  /// Radii in multiples of sqrt(inputs) * spread. The best by generalised cross-validation is taken.
  std::vector<double> widths = {0.5, 1.0, 2.0, 4.0};
  /// Ridge penalties on the output weights, as a share of the units' mean power; the best as above.
  std::vector<double> ridges = {1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1};
  /// A radius is at least this share of the input's spread over all patterns.
  double least_radius = 0.1;
};

struct RbfnSummary {
  int units = 0;
  double width = 0.0;  ///< chosen
  double ridge = 0.0;  ///< chosen
  double effective_weights =
      0.0;  ///< trace of the hat matrix: weights that the ridge left free, with the bias
  double generalised_error = std::numeric_limits<double>::quiet_NaN();  ///< expected mse by cross-validation
  double training_mse = std::numeric_limits<double>::quiet_NaN();
};

struct TrainedRbfn {
  Rbfn rbfn;
  RbfnSummary summary;
};

/// Centres from a self-organising map, then the output weights by ridge regression with penalty and width
/// from generalised cross-validation (Golub, Heath and Wahba 1979). Inputs should be scaled.
TrainedRbfn train_rbfn(const Patterns& patterns, const RbfnOptions& options = {});

void to_json(nlohmann::json& json, const Rbfn& rbfn);
/// Throws Error(input) when shapes do not fit; `where` names the file.
Rbfn rbfn_from_json(const nlohmann::json& json, const std::string& where);

}  // namespace faultline
