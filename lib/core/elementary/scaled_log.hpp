// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "lib/core/elementary/double_double.hpp"

namespace faultline::elementary {

/// For mantissas m from 1 + k / 128 on, 128 of them up to 2; those from kFirstHalved on stand for m / 2.
struct LogEntry {
  double inverse;            ///< about 1 / m, in ten bits, so that products with half a mantissa are exact
  double log_high, log_low;  ///< -log(inverse); the high part is a multiple of 2^-42
};
inline constexpr int kFirstHalved = 52;
extern const std::array<LogEntry, 128> kLogEntries;

/// x = 2^power m, m from 0.703 to 1.406, and m entry.inverse = 1 + coarse + fine exactly, coarse + fine
/// within 1/128 of zero. Around x = 1 power is 0 and the inverse 1, so that nothing cancels.
struct LogParts {
  double power;
  const LogEntry& entry;
  double coarse, fine;
};

/// Numbers with bits from kLeastNormal on and below kInfinite are positive, finite and normal.
inline constexpr std::uint64_t kLeastNormal = std::uint64_t{1} << 52, kInfinite = std::uint64_t{2047} << 52;

/// Returns the parts of a positive, finite and normal x.
inline LogParts log_parts(double x) {
  constexpr std::uint64_t kMantissa = kLeastNormal - 1, kUpperHalf = ~((std::uint64_t{1} << 27) - 1);
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const auto index = static_cast<int>((bits >> 45) & 127);
  const int halved = index >= kFirstHalved ? 1 : 0;
  const std::uint64_t mantissa = (bits & kMantissa) | static_cast<std::uint64_t>(1023 - halved) << 52;
  const double m = std::bit_cast<double>(mantissa), head = std::bit_cast<double>(mantissa & kUpperHalf);
  const LogEntry& entry = kLogEntries[index];
  const int power = static_cast<int>(bits >> 52) - 1023 + halved;
  return {static_cast<double>(power), entry, head * entry.inverse - 1.0, (m - head) * entry.inverse};
}

/// Returns (log(1 + r) - r + r^2 / 2) / r^3 to 2^-51.
inline double log_tail(double r) {
  const double r2 = r * r;
  return (0x1.5555555555559p-2 - r * 0x1.fffffffffdd10p-3) +
         r2 * ((0x1.99999996cde4fp-3 - r * 0x1.5555596278dddp-3) +
               r2 * (0x1.24954c15f9583p-3 - r * 0x1.fd16e27a163eap-4));
}

inline constexpr double kLn2High = 0x1.62e42fefa38p-1, kLn2Low = 0x1.ef35793c7673p-45;

/// Returns log(x + more) to about 66 bits; x positive and finite, `more` at most an ulp of it or x = 1.
inline DoubleDouble precise_log(double x, double more = 0.0) {
  constexpr double kUp = 0x1p54;
  const bool subnormal = std::bit_cast<std::uint64_t>(x) < kLeastNormal;
  const LogParts p = log_parts(subnormal ? x * kUp : x);
  const double power = subnormal ? p.power - 54.0 : p.power;
  DoubleDouble r = sum_of(p.coarse, p.fine);
  if (more != 0.0) r = sum_of(r.high, r.low + more / x * (1.0 + r.high));
  const double steps = power * kLn2High + p.entry.log_high;  // exact
  const DoubleDouble square = product_of(r.high, r.high);
  const DoubleDouble first = sum_of(r.high, -0.5 * square.high);
  const DoubleDouble sum = sum_of(steps, first.high);
  const double small = r.low - r.high * r.low - 0.5 * square.low + square.high * r.high * log_tail(r.high);
  return sum_of_ordered(sum.high, sum.low + (first.low + (small + (p.entry.log_low + power * kLn2Low))));
}

}  // namespace faultline::elementary
