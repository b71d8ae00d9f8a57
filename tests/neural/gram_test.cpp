// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/neural/kernels.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;

MatrixXd lower(const MatrixXd& matrix) { return matrix.triangularView<Eigen::Lower>(); }

MatrixXd gram_of(const MatrixXd& features, VectorUnit unit) {
  MatrixXd gram = MatrixXd::Zero(features.rows(), features.rows());
  add_gram(features, gram, unit);
  return lower(gram);
}

TEST(NeuralGram, IsTheProductWithItsTransposeAddedToWhatWasThere) {
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
