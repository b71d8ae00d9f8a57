// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/neural/kernels.hpp"

namespace faultline {

/// Rows of features that are worked on together; their number is padded to a multiple of it.
inline constexpr int kGramPanel = 24;

/// gram += features features^T (features x samples), in the panels on and below the diagonal; those above it
/// keep what they held. Samples are added one after the other to each entry, so neither the vector unit nor
/// how the samples were split over calls changes a bit. Rows are a multiple of kGramPanel.
void add_gram(const Eigen::MatrixXd& features, Eigen::MatrixXd& gram);
void add_gram(const Eigen::MatrixXd& features, Eigen::MatrixXd& gram, VectorUnit unit);

}  // namespace faultline
