// SPDX-License-Identifier: MIT
#include "lib/neural/rbfn.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"
#include "lib/core/random.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Patterns bumps(int count, std::uint64_t seed) {
  Random random(seed);
  Patterns patterns{MatrixXd(2, count), MatrixXd(1, count)};
  for (int n = 0; n < count; ++n) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
    patterns.inputs.col(n) << x, y;
    patterns.targets(0, n) = std::sin(3 * x) * std::cos(2 * y) + 0.05 * random.normal();
  }
  return patterns;
}

TEST(Rbfn, UnitsAreCauchyWithDiagonalRadii) {
  Rbfn rbfn{MatrixXd(2, 1), MatrixXd(2, 1), MatrixXd::Constant(1, 1, 3.0), VectorXd::Constant(1, 0.5)};
  rbfn.centres << 1.0, -1.0;
  rbfn.inverse_radii << 2.0, 0.5;
  VectorXd x(2);
  x << 2.0, 1.0;
  EXPECT_DOUBLE_EQ(forward(rbfn, x)(0, 0), 0.5 + 3.0 / (1.0 + 4.0 + 1.0));
}

TEST(Rbfn, LearnsASurfaceToItsNoise) {
  const Rbfn trained = train_rbfn(bumps(600, 1), {.rows = 8, .columns = 8});
  EXPECT_LT(mean_squared_error(trained, bumps(500, 2)), 2.0 * 0.05 * 0.05);
}

TEST(Rbfn, ASampleDoesNotDependOnTheOthers) {
  const Rbfn rbfn = train_rbfn(bumps(200, 1));
  const MatrixXd inputs = bumps(37, 5).inputs, together = forward(rbfn, inputs);
  for (int n = 0; n < inputs.cols(); ++n) EXPECT_EQ(forward(rbfn, inputs.col(n))(0, 0), together(0, n));
}

TEST(Rbfn, JsonKeepsEveryBitAndChecksShapes) {
  const Rbfn rbfn = train_rbfn(bumps(200, 1), {.rows = 3, .columns = 4});
  nlohmann::json json;
  to_json(json, rbfn);
  const Rbfn back = rbfn_from_json(nlohmann::json::parse(json.dump()), "test");
  EXPECT_TRUE(back.centres == rbfn.centres && back.inverse_radii == rbfn.inverse_radii &&
              back.weights == rbfn.weights && back.bias == rbfn.bias);
  json["bias"] = {1.0, 2.0};
  EXPECT_THROW(rbfn_from_json(json, "test"), Error);
}

TEST(Som, NodesCoverTheDataAndNeighboursAreNear) {
  const MatrixXd inputs = bumps(800, 3).inputs;
  const SelfOrganisingMap map = train_som(inputs, {.rows = 6, .columns = 6});
  double quantisation = 0.0, neighbours = 0.0, others = 0.0;
  for (int n = 0; n < inputs.cols(); ++n)
    quantisation += (map.nodes.col(nearest_node(map, inputs.col(n))) - inputs.col(n)).norm() / 800.0;
  EXPECT_LT(quantisation, 0.2);  // 36 nodes on a square of side 2 lie a third apart
  int near_pairs = 0, pairs = 0;
  for (int a = 0; a < map.count(); ++a)
    for (int b = 0; b < a; ++b) {
      const double distance = (map.nodes.col(a) - map.nodes.col(b)).norm();
      if (map.grid_distance2(a, b) == 1.0) neighbours += distance, ++near_pairs;
      others += distance, ++pairs;
    }
  EXPECT_LT(neighbours / near_pairs, 0.5 * others / pairs);
}

TEST(Som, OneNodeIsNearTheMean) {
  const MatrixXd inputs = bumps(500, 4).inputs;
  const SelfOrganisingMap map = train_som(inputs, {.rows = 1, .columns = 1});
  EXPECT_LT((map.nodes.col(0) - inputs.rowwise().mean()).norm(), 0.15);
}

}  // namespace
}  // namespace faultline
