// SPDX-License-Identifier: MIT
#include "lib/identify/weak_form/weak_windows.hpp"

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

constexpr int kLengths = 4;               // each twice the one before
constexpr int kMostShifts = 24;           // samples, at most
constexpr double kLongestShift_s = 0.25;  // by which the torque may act earlier or later
constexpr double kWindowsSlow_s = 0.02;   // at longer periods only the neighbouring samples are tried
constexpr int kShapedSteps = 4;           // fewer samples have equal weights

/// Returns a smooth bump over (0, 1), zero with its slope at both ends.
double bump(double x) {
  const double arch = 4.0 * x * (1.0 - x);
  return arch * arch;
}

/// Returns the weights of a window's samples, whose mean over its time is 1.
Eigen::VectorXd weights(const Eigen::Ref<const Eigen::VectorXd>& step_s) {
  const Eigen::Index steps = step_s.size();
  Eigen::VectorXd w = Eigen::VectorXd::Ones(steps);
  for (Eigen::Index k = 0; k < steps && steps >= kShapedSteps; ++k)
    w[k] = bump((static_cast<double>(k) + 0.5) / static_cast<double>(steps));
  return w / w.dot(step_s);
}

bool mostly_empty(const Stretch& s, int begin, int rows) {
  const auto off = s.outlier.block(0, begin, s.joints(), rows).rowwise().sum();
  return off.maxCoeff() * 2 > rows;
}

WeakWindow window_at(const Stretch& s, const StretchTerms& terms, const ShiftRange& shifts, int begin,
                     int steps) {
  const int n = s.joints();
  const Eigen::VectorXd w = weights(terms.step_s.segment(begin, steps));
  const Eigen::VectorXd duration = w.cwiseProduct(terms.step_s.segment(begin, steps));
  const auto mean = [&](const Eigen::MatrixXd& columns) -> Eigen::VectorXd {
    return columns.middleCols(begin, steps) * w;
  };
  WeakWindow out;
  out.log = s.log;
  out.time_s = s.time[begin];
  out.base = mean(terms.base).reshaped(n, Eigen::AutoSize);
  out.coulomb = mean(terms.coulomb).reshaped(n, Eigen::AutoSize);
  out.extra = mean(terms.extra).reshaped(n, Eigen::AutoSize);
  out.viscous = mean(terms.viscous);
  out.skew = mean(terms.skew);
  const Eigen::VectorXd rotor = mean(terms.rotor);
  out.torque.resize(n, shifts.count());
  for (int i = 0; i < shifts.count(); ++i)
    out.torque.col(i) = s.tau.middleCols(begin - shifts.first - i, steps) * duration - rotor;
  out.q = s.q_smooth.col(begin + steps / 2);
  out.dq = s.dq_smooth.col(begin + steps / 2);
  out.speed = s.dq_smooth.middleCols(begin, steps + 1).cwiseAbs().rowwise().mean();
  return out;
}

}  // namespace

void WeakWindows::keep(WeakWindow window) {
  windows_.push_back(std::move(window));
  if (windows_.size() <= max_windows_) return;
  std::vector<WeakWindow> half;
  for (std::size_t i = 0; i < windows_.size(); i += 2) half.push_back(std::move(windows_[i]));
  windows_ = std::move(half);
  stride_ *= 2;
}

void WeakWindows::add(const Stretch& s, const StretchTerms& terms, const ShiftRange& shifts) {
  const int steps = std::max(1, static_cast<int>(std::lround(length_s_ / s.period_s)));
  const int hop = std::max(1, steps / 2);
  if (static_cast<int>(rows_.size()) <= s.log) rows_.resize(s.log + 1, 0);
  const int first = std::max(shifts.last, 0), last = s.rows() - 1 - steps + std::min(shifts.first, 0);
  for (int begin = first; begin <= last; begin += hop) {
    if (mostly_empty(s, begin, steps + 1)) continue;
    rows_[s.log] += hop;
    if (seen_++ % stride_ == 0) keep(window_at(s, terms, shifts, begin, steps));
  }
}

void WeakWindows::keep_extra(const std::vector<int>& terms) {
  for (WeakWindow& w : windows_) w.extra = Eigen::MatrixXd(w.extra(Eigen::all, terms));
}

void WeakWindows::leave_out(const std::vector<bool>& logs) {
  std::erase_if(windows_, [&](const WeakWindow& w) { return logs[w.log]; });
}

std::int64_t WeakWindows::rows_used(int log) const {
  return log < static_cast<int>(rows_.size()) ? rows_[log] : 0;
}

void WeakSets::add(const Stretch& s) {
  const StretchTerms terms = stretch_terms(space, s, extra);
  for (WeakWindows& set : sets) set.add(s, terms, shifts);
}

std::vector<double> window_lengths(double shortest_s, double period_s) {
  std::vector<double> out;
  long before = 0;
  double length = shortest_s;
  for (int i = 0; i < kLengths; ++i, length *= 2.0) {
    const long steps = std::max(1L, std::lround(length / period_s));
    if (steps > before) out.push_back(length);
    before = steps;
  }
  return out;
}

ShiftRange shift_range(double period_s) {
  if (period_s > kWindowsSlow_s) return {-1, 1};
  const int most = std::clamp(static_cast<int>(kLongestShift_s / period_s), 1, kMostShifts);
  return {-most, most};
}

}  // namespace faultline
