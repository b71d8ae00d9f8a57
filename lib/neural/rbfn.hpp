// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lib/neural/patterns.hpp"

namespace faultline {

/// Kohonen's map (Kohonen 1982): nodes on a rectangular grid, each a point of the input space; neighbours on
/// the grid lie close together in it, and dense regions get more nodes.
struct SelfOrganisingMap {
  int rows = 0;
  int columns = 0;
  Eigen::MatrixXd nodes;  ///< inputs x (rows * columns); node (r, c) is column r * columns + c

  int count() const { return rows * columns; }
  /// Squared distance between two nodes on the grid.
  double grid_distance2(int a, int b) const;
};

struct SomOptions {
  int rows = 8;
  int columns = 8;
  int epochs = 20;  ///< number of times that every pattern is shown
  std::uint64_t seed = 1;
};

/// `inputs` (inputs x patterns) should be scaled, as distances are Euclidean. Throws Error(usage) for a map
/// without nodes, Error(input) without patterns or for numbers that are not finite.
SelfOrganisingMap train_som(const Eigen::Ref<const Eigen::MatrixXd>& inputs, const SomOptions& options = {});

/// Returns the node nearest to `input`; the lower number if several are.
int nearest_node(const SelfOrganisingMap& map, const Eigen::Ref<const Eigen::VectorXd>& input);

/// Radial basis function network of Cauchy units: unit u has the activation 1 / (1 + ||R_u^-1 (x -
/// mu_u)||^2), R_u diagonal; the output is a weighted sum of the activations and a bias.
struct Rbfn {
  Eigen::MatrixXd centres;        ///< mu, inputs x units
  Eigen::MatrixXd inverse_radii;  ///< diagonal of R^-1, inputs x units
  Eigen::MatrixXd weights;        ///< outputs x units
  Eigen::VectorXd bias;           ///< outputs

  int inputs() const { return static_cast<int>(centres.rows()); }
  int units() const { return static_cast<int>(centres.cols()); }
  int outputs() const { return static_cast<int>(bias.size()); }
};

/// Outputs x samples for inputs x samples; each sample's result is independent of the others, NaN stays NaN.
Eigen::MatrixXd forward(const Rbfn& rbfn, const Eigen::Ref<const Eigen::MatrixXd>& inputs);
double mean_squared_error(const Rbfn& rbfn, const Patterns& patterns);

/// Places the centres by a self-organising map, then fits the output weights by ridge regression with penalty
/// and width from generalised cross-validation (Golub, Heath and Wahba 1979). Nodes of `map` that are nearest
/// to no pattern are left out. Inputs should be scaled.
Rbfn train_rbfn(const Patterns& patterns, const SomOptions& map = {});

void to_json(nlohmann::json& json, const Rbfn& rbfn);
/// Throws Error(input) if shapes do not fit; `where` names the file.
Rbfn rbfn_from_json(const nlohmann::json& json, const std::string& where);

}  // namespace faultline
