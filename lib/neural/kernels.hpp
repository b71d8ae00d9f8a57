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
void tanh_in_place(double* values, int count);
void tanh_in_place(double* values, int count, VectorUnit unit);

/// out = weights * in + bias for kLanes samples: `in` is [inputs][kLanes], `out` is [outputs][kLanes].
void affine_lanes(const Eigen::MatrixXd& weights, const Eigen::VectorXd& bias, const double* in, double* out);
void affine_lanes(const Eigen::MatrixXd& weights, const Eigen::VectorXd& bias, const double* in, double* out,
                  VectorUnit unit);

/// `sums`[u][lane] = sum over i of ((in[i][lane] - centres(i, u)) * inverse_radii(i, u))^2.
void squared_distances_lanes(const Eigen::MatrixXd& centres, const Eigen::MatrixXd& inverse_radii,
                             const double* in, double* sums);

}  // namespace faultline
