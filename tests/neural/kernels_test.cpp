// SPDX-License-Identifier: MIT
#include "lib/neural/kernels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace faultline {
namespace {

double tanh_by_kernel(double x) {
  std::vector<double> block(kLanes, 0.3);
  block[5] = x;
  tanh_in_place(block.data(), kLanes);
  return block[5];
}

TEST(NeuralKernels, TanhAgreesWithTheLibraryEverywhere) {
  double worst = 0.0;
  for (int i = -60000; i <= 60000; ++i) {
    const double x = i * 3.7e-4, expected = std::tanh(x);
    if (x != 0.0) worst = std::max(worst, std::fabs(tanh_by_kernel(x) - expected) / std::fabs(expected));
  }
  for (double x = 1e-300; x < 1.0; x *= 1.7)
    worst = std::max(worst, std::fabs(tanh_by_kernel(x) - std::tanh(x)) / std::tanh(x));
  EXPECT_LT(worst, 1e-14);
}

TEST(NeuralKernels, TanhKeepsSignsLimitsAndNaN) {
  EXPECT_EQ(tanh_by_kernel(0.0), 0.0);
  EXPECT_TRUE(std::signbit(tanh_by_kernel(-0.0)));
  EXPECT_EQ(tanh_by_kernel(1e300), 1.0);
  EXPECT_EQ(tanh_by_kernel(-std::numeric_limits<double>::infinity()), -1.0);
  EXPECT_TRUE(std::isnan(tanh_by_kernel(std::numeric_limits<double>::quiet_NaN())));
}

TEST(NeuralKernels, AffineLanesIsAMatrixProduct) {
  const Eigen::MatrixXd weights = Eigen::MatrixXd::Random(7, 5), in = Eigen::MatrixXd::Random(5, kLanes);
  const Eigen::VectorXd bias = Eigen::VectorXd::Random(7);
  std::vector<double> lanes(5 * kLanes), out(7 * kLanes);
  for (int i = 0; i < 5; ++i)
    for (int lane = 0; lane < kLanes; ++lane) lanes[i * kLanes + lane] = in(i, lane);
  affine_lanes(weights, bias, lanes.data(), out.data());
  const Eigen::MatrixXd expected = (weights * in).colwise() + bias;
  for (int o = 0; o < 7; ++o)
    for (int lane = 0; lane < kLanes; ++lane) EXPECT_NEAR(out[o * kLanes + lane], expected(o, lane), 1e-14);
}

TEST(NeuralKernels, EveryVectorUnitGivesTheSameBits) {
  const Eigen::MatrixXd weights = Eigen::MatrixXd::Random(33, 21),
                        in = 9.0 * Eigen::MatrixXd::Random(kLanes, 21);
  const Eigen::VectorXd bias = Eigen::VectorXd::Random(33);
  const auto layer = [&](VectorUnit unit) {
    std::vector<double> out(33 * kLanes);
    affine_lanes(weights, bias, in.data(), out.data(), unit);
    tanh_in_place(out.data(), 33 * kLanes, unit);
    return out;
  };
  const auto base = layer(VectorUnit::baseline);
  if (best_vector_unit() != VectorUnit::baseline) {
    EXPECT_EQ(layer(VectorUnit::avx2), base);
  }
  EXPECT_EQ(layer(best_vector_unit()), base);
}

using Eigen::MatrixXd;

MatrixXd lower(const MatrixXd& matrix) { return matrix.triangularView<Eigen::Lower>(); }

MatrixXd gram_of(const MatrixXd& features, VectorUnit unit) {
  MatrixXd gram = MatrixXd::Zero(features.rows(), features.rows());
  add_gram(features, gram, unit);
  return lower(gram);
}

TEST(NeuralGram, AddsTheProductWithItsTransposeToTheMatrix) {
  const MatrixXd features = MatrixXd::Random(3 * kGramPanel, 150);
  MatrixXd gram = MatrixXd::Ones(features.rows(), features.rows());
  add_gram(features, gram);
  const MatrixXd expected = features * features.transpose() + MatrixXd::Ones(gram.rows(), gram.cols());
  EXPECT_LT((lower(gram) - lower(expected)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(gram(0, kGramPanel), 1.0);  // a panel above the diagonal
}

TEST(NeuralGram, EveryVectorUnitGivesTheSameBits) {
  const MatrixXd features = MatrixXd::Random(2 * kGramPanel, 200);
  const MatrixXd base = gram_of(features, VectorUnit::baseline);
  if (best_vector_unit() != VectorUnit::baseline) {
    EXPECT_EQ(gram_of(features, VectorUnit::avx2), base);
  }
  EXPECT_EQ(gram_of(features, best_vector_unit()), base);
}

TEST(NeuralGram, SplittingTheSamplesChangesNoBit) {
  const MatrixXd features = MatrixXd::Random(2 * kGramPanel, 201);
  MatrixXd whole = MatrixXd::Zero(features.rows(), features.rows()), parts = whole;
  add_gram(features, whole);
  add_gram(features.leftCols(77), parts);
  add_gram(features.rightCols(124), parts);
  EXPECT_EQ(lower(parts), lower(whole));
}

TEST(NeuralGram, NoSamplesAddNothing) {
  MatrixXd gram = MatrixXd::Ones(kGramPanel, kGramPanel);
  add_gram(MatrixXd(kGramPanel, 0), gram);
  EXPECT_EQ(gram, MatrixXd::Ones(kGramPanel, kGramPanel));
}

}  // namespace
}  // namespace faultline
