// SPDX-License-Identifier: MIT
#include "lib/neural/training.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "lib/core/error.hpp"
#include "lib/core/random.hpp"
#include "lib/neural/normal_equations.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;

/// Two smooth functions of two inputs.
Patterns surface(int count, std::uint64_t seed, double noise = 0.0) {
  Random random(seed);
  Patterns patterns{MatrixXd(2, count), MatrixXd(2, count)};
  for (int n = 0; n < count; ++n) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
    patterns.inputs.col(n) << x, y;
    patterns.targets.col(n) << std::sin(2 * x) * y + noise * random.normal(),
        std::exp(-x * x - y) + noise * random.normal();
  }
  return patterns;
}

/// Three classes in the plane: inside a circle, and left or right of it.
Patterns classes(int count, std::uint64_t seed) {
  Random random(seed);
  Patterns patterns{MatrixXd(2, count), MatrixXd::Zero(3, count)};
  for (int n = 0; n < count; ++n) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
    patterns.inputs.col(n) << x, y;
    patterns.targets(x * x + y * y < 0.4 ? 0 : x < 0 ? 1 : 2, n) = 1.0;
  }
  return patterns;
}

double share_right(const Mlp& mlp, const Patterns& patterns) {
  const MatrixXd outputs = forward(mlp, patterns.inputs);
  int right = 0;
  for (int n = 0; n < patterns.count(); ++n) {
    int said = 0, true_class = 0;
    outputs.col(n).maxCoeff(&said);
    patterns.targets.col(n).maxCoeff(&true_class);
    right += said == true_class;
  }
  return static_cast<double>(right) / patterns.count();
}

/// Dense normal equations with decay 0.02 of a network 4-5-3, by differences of its outputs: weights have the
/// decay, biases have none.
MatrixXd dense_normal_equations(Mlp mlp, const MatrixXd& inputs) {
  constexpr double kStep = 1e-5;
  const Eigen::VectorXd at = parameters_of(mlp);
  MatrixXd slopes(3 * inputs.cols(), at.size());
  for (int p = 0; p < at.size(); ++p) {
    const auto outputs_beside = [&](double step) {
      Eigen::VectorXd there = at;
      there[p] += step;
      set_parameters(mlp, there);
      return forward(mlp, inputs);
    };
    slopes.col(p) = ((outputs_beside(kStep) - outputs_beside(-kStep)) / (2.0 * kStep)).reshaped();
  }
  MatrixXd dense = slopes.transpose() * slopes / static_cast<double>(inputs.cols());
  for (int p = 0; p < at.size(); ++p) {
    const bool is_bias = (p >= 20 && p < 25) || p >= 40;  // 4 x 5 weights, 5 biases, 5 x 3 weights, 3 biases
    if (!is_bias) dense(p, p) += 0.02;
  }
  return dense;
}

TEST(NormalEquations, AStepOfTheHiddenLayerEqualsThatOfTheDenseEquations) {
  const double damping = 1e-3;
  Mlp mlp = make_mlp({4, 5, 3}, OutputKind::linear, 9);
  const Patterns patterns{MatrixXd::Random(4, 700), MatrixXd::Random(3, 700)};
  mlp.layers[1] = fitted_outputs(mlp, patterns, 0.02);
  const Eigen::VectorXd gradient = loss_gradient(mlp, patterns.inputs, patterns.targets, 0.02).gradient;
  EXPECT_LT(gradient.tail(18).norm(), 1e-9 * gradient.norm());
  MatrixXd dense = dense_normal_equations(mlp, patterns.inputs);
  dense.diagonal().head(25).array() += damping;
  const Eigen::VectorXd expected = -dense.ldlt().solve(gradient);
  const auto step = gauss_newton_step(hidden_layer_matrix(mlp, patterns.inputs, 0.02), gradient, damping);
  ASSERT_TRUE(step);
  EXPECT_LT((step->head(25) - expected.head(25)).norm(), 1e-7 * expected.norm());
  EXPECT_EQ(step->tail(18).norm(), 0.0);
}

TEST(NormalEquations, OutputsAreFittedWhenHiddenUnitsAreCopies) {
  Mlp mlp = make_mlp({2, 4, 1}, OutputKind::linear, 3);
  mlp.layers[0].weights.row(1) = mlp.layers[0].weights.row(0);
  mlp.layers[0].bias[1] = mlp.layers[0].bias[0];
  Patterns patterns{MatrixXd::Random(2, 300), {}};
  patterns.targets = forward(mlp, patterns.inputs);
  mlp.layers[1] = fitted_outputs(mlp, patterns, 0.0);
  EXPECT_LT(mean_squared_error(mlp, patterns), 1e-18);
}

TEST(LevenbergMarquardt, FitsASmoothSurfaceClosely) {
  const Mlp trained = train_levenberg_marquardt(make_mlp({2, 12, 2}), surface(400, 1), surface(200, 2),
                                                {.max_iterations = 80});
  EXPECT_LT(mean_squared_error(trained, surface(500, 3)), 1e-5);
}

TEST(BackPropagation, FitsTheSurfaceAndIsRepeatable) {
  const TrainingOptions options{.max_iterations = 200};
  const Mlp one = train_back_propagation(make_mlp({2, 12, 2}), surface(400, 1), {}, options);
  const Mlp two = train_back_propagation(make_mlp({2, 12, 2}), surface(400, 1), {}, options);
  EXPECT_LT(mean_squared_error(one, surface(500, 3)), 2e-3);
  EXPECT_TRUE(parameters_of(one) == parameters_of(two));
}

TEST(QuasiNewton, ClassifiesHeldOutPatterns) {
  const Mlp trained =
      train_quasi_newton(make_mlp({2, 10, 3}, OutputKind::softmax), classes(800, 1), classes(300, 2));
  EXPECT_GT(share_right(trained, classes(500, 3)), 0.95);
}

TEST(QuasiNewton, TheLossFallsEveryIteration) {
  const Patterns patterns = classes(300, 1);
  double before = std::numeric_limits<double>::infinity();
  for (int iterations = 1; iterations <= 20; ++iterations) {
    const Mlp trained = train_quasi_newton(make_mlp({2, 10, 3}, OutputKind::softmax), patterns, {},
                                           {.max_iterations = iterations, .weight_decay = 0.0});
    const double loss = loss_gradient(trained, patterns.inputs, patterns.targets).loss;
    EXPECT_LE(loss, before);
    before = loss;
  }
}

TEST(Training, StopsAtTheLimitOfIterations) {
  int iterations = 0;
  train_levenberg_marquardt(make_mlp({2, 8, 2}), surface(200, 1), {}, {.max_iterations = 2},
                            [&](const std::string&, double) { ++iterations; });
  EXPECT_EQ(iterations, 2);
}

TEST(Training, ValidationKeepsTheBestWeights) {  // 25 noisy patterns cannot hold 12 hidden units
  const Patterns few = surface(25, 1, 0.3), validation = surface(300, 2);
  int iterations = 0;
  const Mlp free_run = train_levenberg_marquardt(make_mlp({2, 12, 2}), few, {}, {.max_iterations = 60});
  const Mlp watched =
      train_levenberg_marquardt(make_mlp({2, 12, 2}), few, validation, {.max_iterations = 60, .patience = 8},
                                [&](const std::string&, double) { ++iterations; });
  EXPECT_LT(iterations, 60);
  EXPECT_LT(mean_squared_error(watched, validation), 0.5 * mean_squared_error(free_run, validation));
}

TEST(Training, RefusesBadPatterns) {
  Patterns bad = surface(20, 1);
  bad.inputs(0, 7) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(train_quasi_newton(make_mlp({2, 4, 2}), bad, {}), Error);
  EXPECT_THROW(train_quasi_newton(make_mlp({3, 4, 2}), surface(20, 1), {}), Error);
  EXPECT_THROW(train_quasi_newton(make_mlp({2, 4, 2}), {}, {}), Error);
}

TEST(Patterns, SplitKeepsEveryPatternOnce) {
  const Patterns all = surface(101, 1);
  const PatternSplit split = split_patterns(all, 0.25, 3);
  EXPECT_EQ(split.validation.count(), 25);
  EXPECT_EQ(split.training.count(), 76);
  EXPECT_NEAR(split.training.inputs.sum() + split.validation.inputs.sum(), all.inputs.sum(), 1e-12);
}

}  // namespace
}  // namespace faultline
