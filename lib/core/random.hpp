// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace faultline {

/// Seeded generator (xoshiro256**, Blackman and Vigna) whose draws are the same on every platform, unlike
/// the distributions of <random>.
class Random {
 public:
  explicit Random(std::uint64_t seed = 1);

  std::uint64_t bits();
  /// Uniform in [0, 1).
  double uniform();
  double uniform(double low, double high);
  /// Uniform in 0 .. n-1; n > 0.
  std::uint64_t below(std::uint64_t n);
  /// Normal with mean 0 and standard deviation 1.
  double normal();
  /// Returns an independent generator for item `stream` of this seed, so that parallel work draws the same
  /// numbers in any order.
  static Random stream(std::uint64_t seed, std::uint64_t stream);

 private:
  std::array<std::uint64_t, 4> state_;
  double spare_normal_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace faultline
