// SPDX-License-Identifier: MIT
#include "lib/reproduce/filter/gaussian_state.hpp"

#include <algorithm>

namespace faultline {

GaussianState& GaussianState::operator=(const GaussianState& other) {
  size = other.size;
  std::copy_n(other.mean.begin(), size, mean.begin());
  std::copy_n(other.covariance.begin(), size * size, covariance.begin());
  return *this;
}

GaussianState extended(const GaussianState& state, int size) {
  GaussianState out;
  out.size = size;
  std::fill_n(out.mean.begin(), size, 0.0);
  std::fill_n(out.covariance.begin(), size * size, 0.0);
  std::copy_n(state.mean.begin(), state.size, out.mean.begin());
  for (int i = 0; i < state.size; ++i)
    for (int j = 0; j < state.size; ++j) out.p(i, j) = state.p(i, j);
  return out;
}

ScalarUpdate observe(GaussianState& state, int index, int other, double factor, double z,
                     double noise_variance, double tail) {
  const int n = state.size;
  StateVector ph;  // covariance times the observation row
  std::copy_n(&state.covariance[index * n], n, ph.begin());
  double predicted = state.mean[index];
  if (other >= 0) {
    for (int i = 0; i < n; ++i) ph[i] += factor * state.p(other, i);
    predicted += factor * state.mean[other];
  }
  ScalarUpdate update;
  update.innovation = z - predicted;
  update.variance = ph[index] + (other >= 0 ? factor * ph[other] : 0.0) + noise_variance;
  const double counted = update.innovation / tail;
  update.variance = std::max(update.variance, counted * counted);
  const double inverse = 1.0 / update.variance;
  for (int i = 0; i < n; ++i) {
    const double gain = ph[i] * inverse;
    state.mean[i] += gain * update.innovation;
    double* row = &state.covariance[i * n];
    for (int j = 0; j < n; ++j) row[j] -= gain * ph[j];
  }
  return update;
}

void propagate_covariance(GaussianState& state, std::span<const double> rows, int moving) {
  const int n = state.size;
  std::array<double, 2 * kMaxJoints * kMaxStates> half;  // A covariance, the moving rows
  for (int i = 0; i < moving; ++i) {
    double* row = &half[i * n];
    std::fill_n(row, n, 0.0);
    for (int k = 0; k < n; ++k) {
      const double a = rows[i * n + k];
      if (a == 0.0) continue;
      const double* source = &state.covariance[k * n];
      for (int j = 0; j < n; ++j) row[j] += a * source[j];
    }
  }
  for (int i = 0; i < moving; ++i) {
    for (int j = i; j < moving; ++j) {
      double sum = 0.0;
      for (int k = 0; k < n; ++k) sum += half[i * n + k] * rows[j * n + k];
      state.p(i, j) = sum;
      state.p(j, i) = sum;
    }
    for (int j = moving; j < n; ++j) state.p(i, j) = state.p(j, i) = half[i * n + j];
  }
}

void blend_with(GaussianState& state, const StateVector& other, int moving) {
  constexpr double kUniformSpread = 12.0;
  StateVector d;
  for (int i = 0; i < moving; ++i) {
    d[i] = other[i] - state.mean[i];
    state.mean[i] += 0.5 * d[i];
  }
  for (int i = 0; i < moving; ++i)
    for (int j = 0; j < moving; ++j) state.p(i, j) += d[i] * d[j] / kUniformSpread;
}

void relax(GaussianState& state, int index, double kept) {
  state.mean[index] *= kept;
  for (int i = 0; i < state.size; ++i) {
    state.p(index, i) *= kept;
    state.p(i, index) *= kept;
  }
}

}  // namespace faultline
