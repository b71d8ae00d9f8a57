// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/robot/chain.hpp"

namespace faultline {

/// What a filter leaves unexplained of the numbers it was shown: nothing but white noise where its robot is
/// the one in the log (Kailath, 1968).
class Surprise {
 public:
  /// Innovations of position and velocity of joint `j`, over their standard deviations; 0 where not measured.
  void add(int j, double whitened_q, double whitened_dq, bool has_dq) {
    add_number(2 * j, whitened_q);
    if (has_dq) add_number(2 * j + 1, whitened_dq);
  }
  double numbers() const { return numbers_; }
  /// Rows that they came from, where each gave as many.
  double rows() const { return channels_ > 0.0 ? numbers_ / channels_ : 0.0; }
  /// Mean square, 1 of white noise; NaN of nothing.
  double mean_square() const { return numbers_ > 0.0 ? squares_ / numbers_ : std::nan(""); }
  /// Correlation of an innovation with the one before, 0 of white noise.
  double correlation() const { return squares_ > 0.0 ? products_ / squares_ : std::nan(""); }

 private:
  static constexpr double kMost = 5.0;  // standard deviations that count: single wild values are no misfit

  void add_number(int index, double whitened) {
    const double w = std::clamp(whitened, -kMost, kMost);
    bool& seen = seen_[static_cast<std::size_t>(index)];
    channels_ += seen ? 0.0 : 1.0;
    seen = true;
    squares_ += w * w;
    products_ += w * last_[static_cast<std::size_t>(index)];
    last_[static_cast<std::size_t>(index)] = w;
    numbers_ += 1.0;
  }

  double numbers_ = 0.0, squares_ = 0.0, products_ = 0.0, channels_ = 0.0;
  std::array<bool, 2 * kMaxJoints> seen_{};
  std::array<double, 2 * kMaxJoints> last_{};
};

/// Whether that is no noise, held against what the filter usually leaves: larger, or the same again and
/// again. A free-form push explains much of anything, so it may leave less than a fault that is specific.
bool is_far_from_white(const Surprise& left, const Surprise& usual, bool is_specific = false);

}  // namespace faultline
