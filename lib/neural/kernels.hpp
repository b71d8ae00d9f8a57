// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

/// The target of functions with vectors of 512 bits. g++ splits them into two of 256 bits unless it is asked
/// not to; clang++ has no such option in a target.
#ifdef __clang__
#define FAULTLINE_AVX512 "avx512f"
#else
#define FAULTLINE_AVX512 "avx512f,prefer-vector-width=512"
#endif

/// Inner loops of the networks. Each sample is a lane of its own, and the order of the operations in a lane
/// is fixed, so that a result does not depend on the number of samples processed together.

namespace faultline {

/// Samples that are processed side by side.
inline constexpr int kLanes = 16;

/// Vector instructions to use; all give the same bits.
enum class VectorUnit { baseline, avx2, avx512 };
/// Returns the widest unit of this processor, the default of the functions below.
VectorUnit best_vector_unit();

/// tanh of `count` numbers in place, without libm, relative error below 1e-14; NaN stays NaN. `count` must be
/// a multiple of kLanes.
void tanh_in_place(double* values, int count, VectorUnit unit = best_vector_unit());

/// out = weights * in + bias for kLanes samples: `in` is [inputs][kLanes], `out` is [outputs][kLanes].
void affine_lanes(const Eigen::MatrixXd& weights, const Eigen::VectorXd& bias, const double* in, double* out,
                  VectorUnit unit = best_vector_unit());

/// `sums`[u][lane] = sum over i of ((in[i][lane] - centres(i, u)) * inverse_radii(i, u))^2.
void squared_distances_lanes(const Eigen::MatrixXd& centres, const Eigen::MatrixXd& inverse_radii,
                             const double* in, double* sums);

/// Rows of features that are processed together; the number of rows is padded to a multiple of it.
inline constexpr int kGramPanel = 24;

/// gram += features features^T (features x samples), in the panels on and below the diagonal; those above it
/// are unchanged. Samples are added one after the other to each entry, so that neither the vector unit nor
/// the split of the samples over calls changes a bit. The number of rows must be a multiple of kGramPanel.
void add_gram(const Eigen::MatrixXd& features, Eigen::MatrixXd& gram, VectorUnit unit = best_vector_unit());

}  // namespace faultline
