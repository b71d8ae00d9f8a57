// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace faultline {

struct ReproduceOptions {
  int seeds = 5;           ///< experiments, each with its own data and start weights
  std::uint64_t seed = 1;  ///< of the first; the others follow
  bool quick = false;      ///< fewer patterns, runs and hours: orders of magnitude within a minute
  int threads = 0;         ///< 0 = one a core; changes no number

  /// Throws Error(usage) naming the field, its value and its bound.
  void check() const;
};

}  // namespace faultline
