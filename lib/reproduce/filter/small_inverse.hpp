// SPDX-License-Identifier: MIT
#pragma once

#include "lib/reproduce/filter/joint_array.hpp"

namespace faultline {

/// Inverse of the `count` x `count` matrix in `work` (destroyed) by Gauss-Jordan without pivoting: for
/// positive definite matrices and those near the identity.
void invert_general(JointSquare& work, int count, JointSquare& inverse);

/// Inverse of a symmetric positive definite matrix with row and column `locked` left out (as zeros); -1 for
/// none.
void invert_inertia(const JointMatrix<double>& m, int locked, JointSquare& out);

}  // namespace faultline
