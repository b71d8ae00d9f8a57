// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/neural/kernels.hpp"

namespace faultline {

/// Rows of features that are processed together; the number of rows is padded to a multiple of it.
inline constexpr int kGramPanel = 24;

/// gram += features features^T (features x samples), in the panels on and below the diagonal; those above it
/// are unchanged. Samples are added one after the other to each entry, so that neither the vector unit nor
/// the split of the samples over calls changes a bit. The number of rows must be a multiple of kGramPanel.
void add_gram(const Eigen::MatrixXd& features, Eigen::MatrixXd& gram);
void add_gram(const Eigen::MatrixXd& features, Eigen::MatrixXd& gram, VectorUnit unit);

}  // namespace faultline
