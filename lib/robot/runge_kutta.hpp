// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace faultline {

/// Advances `q` and `dq` by `h` seconds with one Runge-Kutta step of fourth order. `acceleration(after, q,
/// dq, ddq)` writes the acceleration at a state `after` seconds from the start; `a1` is the one at the start.
template <typename Vector, typename Acceleration>
void runge_kutta_step(double h, const Vector& a1, const Acceleration& acceleration, Vector& q, Vector& dq) {
  const Eigen::Index n = q.size();
  Vector a2(n), a3(n), a4(n), v2(n), v3(n), v4(n), x(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    v2[i] = dq[i] + 0.5 * h * a1[i];
    x[i] = q[i] + 0.5 * h * dq[i];
  }
  acceleration(0.5 * h, x, v2, a2);
  for (Eigen::Index i = 0; i < n; ++i) {
    v3[i] = dq[i] + 0.5 * h * a2[i];
    x[i] = q[i] + 0.5 * h * v2[i];
  }
  acceleration(0.5 * h, x, v3, a3);
  for (Eigen::Index i = 0; i < n; ++i) {
    v4[i] = dq[i] + h * a3[i];
    x[i] = q[i] + h * v3[i];
  }
  acceleration(h, x, v4, a4);
  for (Eigen::Index i = 0; i < n; ++i) {
    q[i] += h / 6.0 * (dq[i] + 2.0 * v2[i] + 2.0 * v3[i] + v4[i]);
    dq[i] += h / 6.0 * (a1[i] + 2.0 * a2[i] + 2.0 * a3[i] + a4[i]);
  }
}

}  // namespace faultline
