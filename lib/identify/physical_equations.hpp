// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "lib/identify/physical.hpp"

namespace faultline {

/// A mass, a length or a payload of the equations.
struct PhysicalUnknown {
  std::string name;
  char kind = 'm';  ///< m, l, or p for the payload of group `index`
  int index = 0;    ///< of the link or group
  double value = 1.0;
  double std = 0.0;    ///< of the known fact; 0 = none
  bool exact = false;  ///< given exactly, so not solved for
};

/// beta(masses, lengths, payload) = estimate for every group of logs with its own payload, in the logarithms
/// of the open unknowns. A payload adds a point mass at the tip: on a SCARA da = l1^2 dm, db = l2^2 dm,
/// dc = l1 l2 dm.
class PhysicalEquations {
 public:
  PhysicalEquations(const Robot& robot, const ParameterSpace& space, std::span<const BaseEstimate> groups);

  const std::vector<PhysicalUnknown>& unknowns() const { return unknowns_; }
  /// Returns the unknowns to be solved for: those that are not given exactly.
  const std::vector<PhysicalUnknown>& open() const { return open_; }
  /// Number of usable base parameters, over all groups.
  int rows() const;
  /// Returns the largest absolute value of a base parameter.
  double scale() const;

  /// Returns the relative change of each base parameter of each group by each open unknown's logarithm.
  Eigen::MatrixXd relative_slopes(const Eigen::VectorXd& log_open) const;
  /// The same for one group alone with a further payload of `more` kg.
  Eigen::MatrixXd relative_slopes(const Eigen::VectorXd& log_open, int group, double more) const;
  /// Computes the whitened residual and, if `j` is not null, its slopes; uncertain facts come last.
  void evaluate(const Eigen::VectorXd& log_open, Eigen::VectorXd& r, Eigen::MatrixXd* j) const;

 private:
  struct Group {
    std::vector<int> parameters;
    Eigen::VectorXd target;
    Eigen::MatrixXd whitener;
  };

  bool belongs_to_general_link(int parameter) const;
  void list_unknowns(std::span<const BaseEstimate> groups);
  void add_group(const BaseEstimate& estimate);
  Eigen::VectorXd base(const Eigen::VectorXd& log_open, int group, double more) const;
  Eigen::MatrixXd slopes(const Eigen::VectorXd& log_open, int group, double more) const;

  const Robot& robot_;
  const ParameterSpace& space_;
  std::vector<PhysicalUnknown> unknowns_, open_;
  std::vector<Group> groups_;
};

}  // namespace faultline
