// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "lib/core/matrix/decompositions.hpp"
#include "lib/core/random.hpp"
#include "lib/identify/verdict/fit_verdict.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

constexpr int kPoses = 200;            // random positions in each range
constexpr double kSurelyNegative = 4;  // standard deviations below zero: clearly negative
constexpr double kRoundedZero = 1e-9;  // of the largest eigenvalue: rounding

using Range = std::array<double, 2>;

/// Returns the position range of each joint in the windows of the logs; empty if there are none.
std::vector<Range> ranges_of(const Identification& id) {
  std::vector<Range> ranges;
  for (const JointFit& fit : id.joint_fits) {
    if (fit.q.empty()) return {};
    const auto [low, high] = std::minmax_element(fit.q.begin(), fit.q.end());
    ranges.push_back({*low, *high});
  }
  return ranges;
}

/// The least eigenvalue of the inertia matrix at one position.
struct LeastInertia {
  double value = 0.0;  ///< 0 if none is negative
  double std = 0.0;
  int joint = 0;          ///< from 0: the joint with the largest part in that direction
  double at_joint = 0.0;  ///< its inertia while the others are at rest
};

LeastInertia least_inertia(const ParameterSpace& space, const Identification& id, const JointVector& q) {
  const Eigen::MatrixXd matrix = inertia_matrix(chain_from(space, id.estimate), q);
  const SymmetricEigen eigen = symmetric_eigen(matrix);
  Eigen::Index least = 0;
  const double value = eigen.values.minCoeff(&least);
  LeastInertia out;
  if (value >= -kRoundedZero * eigen.values.cwiseAbs().maxCoeff()) return out;
  const Eigen::VectorXd direction = eigen.vectors.col(least);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(id.estimate.size());
  for (int p = 0; p < space.rigid(); ++p) {
    Eigen::VectorXd more = id.estimate;
    more[p] += 1.0;  // the matrix is linear in this parameter
    const Eigen::MatrixXd other = inertia_matrix(chain_from(space, more), q);
    gradient[p] = direction.dot((other - matrix) * direction);
  }
  Eigen::Index joint = 0;
  direction.cwiseAbs().maxCoeff(&joint);
  out.value = value;
  out.std = std::sqrt(std::max(gradient.dot(id.covariance * gradient), 0.0));
  out.joint = static_cast<int>(joint);
  out.at_joint = matrix(joint, joint);
  return out;
}

/// Returns the worst of some positions; `sure`: only of those with a clearly negative value.
LeastInertia worst_within(const std::vector<Range>& ranges, bool sure, const Identification& id) {
  Random random(1);
  LeastInertia worst;
  for (int k = 0; k < kPoses; ++k) {
    JointVector q(static_cast<Eigen::Index>(ranges.size()));
    for (std::size_t j = 0; j < ranges.size(); ++j) q[j] = random.uniform(ranges[j][0], ranges[j][1]);
    const LeastInertia least = least_inertia(id.space, id, q);
    const bool counts = !sure || least.value + kSurelyNegative * least.std < 0.0;
    if (counts && least.value < worst.value) worst = least;
  }
  return worst;
}

}  // namespace

std::optional<FitStatus> negative_inertia(const Identification& id) {
  std::vector<Range> ranges = ranges_of(id);
  if (ranges.empty()) return std::nullopt;
  LeastInertia worst = worst_within(ranges, false, id);
  if (worst.value == 0.0) {
    for (std::size_t j = 0; j < ranges.size(); ++j)
      if (id.space.chain.geometry[j].kind == AxisKind::revolute)
        ranges[j] = {-std::numbers::pi, std::numbers::pi};
    worst = worst_within(ranges, true, id);
  }
  if (worst.value == 0.0) return std::nullopt;
  const bool turns = id.space.chain.geometry[worst.joint].kind == AxisKind::revolute;
  std::string reason = fmt::format(
      "the inertia of joint {} was estimated as {:.4g} {}, and no robot has a negative one: if the "
      "positions are in another unit, such as revolutions or degrees instead of radians, write the unit of "
      "each q into [log.columns] of the robot file",
      worst.joint + 1, std::min(worst.at_joint, worst.value), turns ? "kg m^2" : "kg");
  return FitStatus{IdentificationStatus::unexplained, std::move(reason)};
}

}  // namespace faultline
