// SPDX-License-Identifier: MIT
#include "lib/reproduce/filter/small_inverse.hpp"

#include <algorithm>

namespace faultline {
namespace {

/// By cofactors: most SCARA logs have three joints, and this runs twice a row.
void invert_three(const JointMatrix<double>& m, JointSquare& out) {
  const double a = m(0, 0), b = m(0, 1), c = m(0, 2), d = m(1, 1), e = m(1, 2), f = m(2, 2);
  const double c00 = d * f - e * e, c01 = c * e - b * f, c02 = b * e - c * d;
  const double scale = 1.0 / (a * c00 + b * c01 + c * c02);
  out[0] = c00 * scale;
  out[1] = out[3] = c01 * scale;
  out[2] = out[6] = c02 * scale;
  out[4] = (a * f - c * c) * scale;
  out[5] = out[7] = (b * c - a * e) * scale;
  out[8] = (a * d - b * b) * scale;
}

}  // namespace

void invert_general(JointSquare& work, int count, JointSquare& inverse) {
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) inverse[i * count + j] = i == j ? 1.0 : 0.0;
  for (int k = 0; k < count; ++k) {
    const double scale = 1.0 / work[k * count + k];
    for (int j = 0; j < count; ++j) {
      work[k * count + j] *= scale;
      inverse[k * count + j] *= scale;
    }
    for (int i = 0; i < count; ++i) {
      if (i == k) continue;
      const double factor = work[i * count + k];
      for (int j = 0; j < count; ++j) {
        work[i * count + j] -= factor * work[k * count + j];
        inverse[i * count + j] -= factor * inverse[k * count + j];
      }
    }
  }
}

void invert_inertia(const JointMatrix<double>& m, int locked, JointSquare& out) {
  const int n = static_cast<int>(m.rows());
  if (n == 3 && locked < 0) return invert_three(m, out);
  std::array<int, kMaxJoints> free{};
  int count = 0;
  for (int i = 0; i < n; ++i)
    if (i != locked) free[count++] = i;
  JointSquare work, inverse;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) work[i * count + j] = m(free[i], free[j]);
  invert_general(work, count, inverse);
  std::fill_n(out.begin(), n * n, 0.0);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) out[free[i] * n + free[j]] = inverse[i * count + j];
}

}  // namespace faultline
