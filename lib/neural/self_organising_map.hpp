// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

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
  int epochs = 20;              ///< number of times that every pattern is shown
  double initial_rate = 0.5;    ///< initial fraction of the distance to a pattern that a node moves
  double final_rate = 0.01;     ///< final fraction; decreases geometrically
  double initial_radius = 0.0;  ///< of the neighbourhood in grid steps; 0 = half the longer side
  double final_radius = 0.4;
  std::uint64_t seed = 1;
};

/// `inputs` (inputs x patterns) should be scaled, as distances are Euclidean. Throws Error(usage) for a map
/// without nodes, Error(input) without patterns or for numbers that are not finite.
SelfOrganisingMap train_som(const Eigen::Ref<const Eigen::MatrixXd>& inputs, const SomOptions& options = {});

/// Returns the node nearest to `input`; the lower number if several are.
int nearest_node(const SelfOrganisingMap& map, const Eigen::Ref<const Eigen::VectorXd>& input);

}  // namespace faultline
