// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "lib/diagnose/curves/curves.hpp"

namespace faultline {

/// Fills an Envelope from samples in the order of time.
class EnvelopeBuilder {
 public:
  explicit EnvelopeBuilder(int bins = 0) : bins_(static_cast<std::size_t>(bins)) {}

  /// Adds a sample to a bin. A value that is not finite was not measured: it leaves a gap.
  void add(int bin, double value) {
    Bin& b = bins_[static_cast<std::size_t>(bin)];
    const auto v = static_cast<float>(value);
    b.reached = true;
    if (!std::isfinite(v)) return;
    any_ = true;
    if (!(v >= b.low)) {
      if (std::isnan(b.low)) b.high = v;
      b.low = v;
      b.low_is_last = true;
    } else if (v > b.high) {
      b.high = v;
      b.low_is_last = false;
    }
  }

  /// Returns the envelope. A single bin that the samples of a jittering clock skip holds the value before it.
  Envelope envelope() const {
    Envelope out;
    if (!any_) return out;
    out.values.reserve(2 * bins_.size());
    for (std::size_t i = 0; i < bins_.size(); ++i) {
      const Bin& b = bins_[i];
      const bool between = !b.reached && i > 0 && i + 1 < bins_.size() && bins_[i + 1].reached;
      const float held = between ? out.values.back() : b.low;
      out.values.push_back(between ? held : b.low_is_last ? b.high : b.low);
      out.values.push_back(between ? held : b.low_is_last ? b.low : b.high);
    }
    return out;
  }

 private:
  struct Bin {
    float low = std::numeric_limits<float>::quiet_NaN();
    float high = std::numeric_limits<float>::quiet_NaN();
    bool low_is_last = false;
    bool reached = false;
  };
  std::vector<Bin> bins_;
  bool any_ = false;
};

}  // namespace faultline
