// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "lib/diagnosis/run_curves.hpp"

namespace faultline {

/// Fills an Envelope from samples in the order of time.
class EnvelopeBuilder {
 public:
  explicit EnvelopeBuilder(int bins = 0) : bins_(static_cast<std::size_t>(bins)) {}

  /// A number that is not finite says nothing.
  void add(int bin, double value) {
    Bin& b = bins_[static_cast<std::size_t>(bin)];
    const auto v = static_cast<float>(value);
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

  Envelope envelope() const {
    Envelope out;
    if (!any_) return out;
    out.values.reserve(2 * bins_.size());
    for (const Bin& b : bins_) {
      out.values.push_back(b.low_is_last ? b.high : b.low);
      out.values.push_back(b.low_is_last ? b.low : b.high);
    }
    return out;
  }

 private:
  struct Bin {
    float low = std::numeric_limits<float>::quiet_NaN();
    float high = std::numeric_limits<float>::quiet_NaN();
    bool low_is_last = false;
  };
  std::vector<Bin> bins_;
  bool any_ = false;
};

}  // namespace faultline
