// SPDX-License-Identifier: MIT
#include "lib/neural/mlp.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"
#include "lib/neural/patterns.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Targets that suit the output: anything, or numbers between 0 and 1, or probabilities that sum to 1.
MatrixXd targets_for(OutputKind output, int rows, int columns) {
  MatrixXd targets = MatrixXd::Random(rows, columns);
  if (output == OutputKind::linear) return targets;
  targets = (0.5 * (targets.array() + 1.0)).matrix();
  if (output == OutputKind::softmax) targets.array().rowwise() /= targets.colwise().sum().array().eval();
  return targets;
}

class MlpOutputs : public testing::TestWithParam<OutputKind> {};

TEST_P(MlpOutputs, GradientAgreesWithDifferences) {
  const Mlp mlp = make_mlp({4, 6, 5, 3}, GetParam(), 7);
  const MatrixXd inputs = MatrixXd::Random(4, 11), targets = targets_for(GetParam(), 3, 11);
  const double decay = 0.01, step = 1e-6;
  const VectorXd at = parameters_of(mlp);
  const VectorXd gradient = loss_gradient(mlp, inputs, targets, decay).gradient;
  Mlp moved = mlp;
  for (int p = 0; p < mlp.parameters(); ++p) {
    VectorXd there = at;
    there[p] = at[p] + step;
    set_parameters(moved, there);
    const double above = loss_gradient(moved, inputs, targets, decay).loss;
    there[p] = at[p] - step;
    set_parameters(moved, there);
    const double below = loss_gradient(moved, inputs, targets, decay).loss;
    EXPECT_NEAR(gradient[p], (above - below) / (2 * step), 1e-8) << "parameter " << p;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, MlpOutputs,
                         testing::Values(OutputKind::linear, OutputKind::logistic, OutputKind::softmax),
                         [](const auto& kind) { return std::string(to_string(kind.param)); });

TEST(Mlp, ASampleDoesNotDependOnTheOthers) {
  const Mlp mlp = make_mlp({9, 49, 6}, OutputKind::linear, 3);
  const MatrixXd inputs = MatrixXd::Random(9, 70);
  const MatrixXd together = forward(mlp, inputs);
  for (int n = 0; n < 70; ++n) EXPECT_TRUE(forward(mlp, inputs.col(n)) == together.col(n)) << n;
}

TEST(Mlp, ForwardEqualsTheFormula) {
  const Mlp mlp = make_mlp({3, 4, 2}, OutputKind::linear, 5);
  const VectorXd x = VectorXd::Random(3);
  const VectorXd h = (mlp.layers[0].weights * x + mlp.layers[0].bias).array().tanh();
  const VectorXd y = mlp.layers[1].weights * h + mlp.layers[1].bias;
  EXPECT_LT((forward(mlp, x) - y).norm(), 1e-14);
}

TEST(Mlp, NaNInGivesNaNOutForThatSampleOnly) {
  const Mlp mlp = make_mlp({3, 4, 2});
  MatrixXd inputs = MatrixXd::Random(3, 5);
  inputs(1, 2) = std::numeric_limits<double>::quiet_NaN();
  const MatrixXd outputs = forward(mlp, inputs);
  EXPECT_TRUE(outputs.col(2).array().isNaN().all());
  EXPECT_TRUE(outputs.leftCols(2).allFinite() && outputs.rightCols(2).allFinite());
}

TEST(Mlp, JsonKeepsEveryBit) {
  Mlp mlp = make_mlp({5, 7, 4, 2}, OutputKind::softmax, 11);
  mlp.layers[0].weights(0, 0) = -0.0;
  mlp.layers[0].weights(1, 0) = 4.9e-324;
  mlp.layers[0].weights(2, 0) = 0.1 + 0.2;
  nlohmann::json json;
  to_json(json, mlp);
  const Mlp back = mlp_from_json(nlohmann::json::parse(json.dump()), "test");
  const VectorXd before = parameters_of(mlp), after = parameters_of(back);
  ASSERT_EQ(before.size(), after.size());
  EXPECT_EQ(std::memcmp(before.data(), after.data(), sizeof(double) * before.size()), 0);
  EXPECT_EQ(back.output, OutputKind::softmax);
}

std::string message_of(const nlohmann::json& json) {
  try {
    mlp_from_json(json, "model.json");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    return error.what();
  }
  return "no error";
}

TEST(Mlp, JsonErrorsNameThePlace) {
  nlohmann::json good;
  to_json(good, make_mlp({2, 3, 1}));
  nlohmann::json bad = good;
  bad["layers"][1]["bias"] = {1.0, 2.0};
  EXPECT_NE(message_of(bad).find("layer 2"), std::string::npos) << message_of(bad);
  bad = good;
  bad["layers"][0]["weights"][1] = {1.0};
  EXPECT_NE(message_of(bad).find("row 2"), std::string::npos) << message_of(bad);
  bad = good;
  bad["layers"][0]["weights"][0][0] = nullptr;
  EXPECT_NE(message_of(bad).find("finite"), std::string::npos) << message_of(bad);
  bad = good;
  bad.erase("output");
  EXPECT_NE(message_of(bad).find("output"), std::string::npos) << message_of(bad);
  EXPECT_NE(message_of(nlohmann::json::array()).find("missing"), std::string::npos);
}

TEST(Scaler, MapsTheRangeAndBack) {
  MatrixXd values(2, 3);
  values << 1.0, 2.0, 5.0, 7.0, 7.0, 7.0;
  const Scaler scaler = range_scaler(values);
  const MatrixXd scaled = scaler.apply(values);
  EXPECT_DOUBLE_EQ(scaled(0, 0), -1.0);
  EXPECT_DOUBLE_EQ(scaled(0, 2), 1.0);
  EXPECT_DOUBLE_EQ(scaled(1, 1), 0.0);
  EXPECT_LT((scaler.invert(scaled) - values).norm(), 1e-14);
  const MatrixXd standard = standard_scaler(values).apply(values);
  EXPECT_NEAR(standard.row(0).mean(), 0.0, 1e-15);
  EXPECT_NEAR(standard.row(0).squaredNorm() / 3.0, 1.0, 1e-14);
}

TEST(Scaler, JsonKeepsEveryBitAndRefusesZeroFactors) {
  const Scaler scaler = standard_scaler(MatrixXd::Random(4, 9));
  nlohmann::json json;
  to_json(json, scaler);
  const Scaler back = scaler_from_json(nlohmann::json::parse(json.dump()), "test");
  EXPECT_TRUE(back.offset == scaler.offset && back.factor == scaler.factor);
  json["factor"][2] = 0.0;
  EXPECT_THROW(scaler_from_json(json, "test"), Error);
}

}  // namespace
}  // namespace faultline
