// SPDX-License-Identifier: MIT
// How read_number() reads a number without a loop over its digits. Only for code selected at run time: see
// wide_rows.hpp.
#pragma once

#include <fast_float/fast_float.h>
#include <immintrin.h>

#include <array>
#include <bit>
#include <cstdint>

#include "formats/csv/wide_rows.hpp"

#define FAULTLINE_AVX2 __attribute__((target("avx2,bmi,bmi2,lzcnt,popcnt")))
#define FAULTLINE_AVX2_INLINE FAULTLINE_AVX2 __attribute__((always_inline)) inline

namespace faultline::avx2 {

inline constexpr int kWidth = 32;  ///< bytes of a register
/// Number of digits that always fit into the 53 bits of a double, so that one division rounds correctly.
inline constexpr unsigned kExactDigits = 15;
/// Largest number before 16 more digits that fits into a mantissa of 64 bits.
inline constexpr std::uint64_t kMostUpper = 999;

/// Bytes 0 up to kWidth, then 0xff: from index n on, the mask of the last n of kWidth bytes.
alignas(64) inline constexpr auto kLastBytes = [] {
  std::array<unsigned char, 3 * kWidth> bytes{};
  for (std::size_t i = kWidth; i < bytes.size(); ++i) bytes[i] = 0xff;
  return bytes;
}();

inline constexpr std::array<double, kExactDigits + 1> kPowersOfTen = {
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

/// Returns digits as numbers from 0 to 9; any other character becomes more than 9.
FAULTLINE_AVX2_INLINE __m256i digits_at(const char* p) {
  const __m256i bytes = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
  return _mm256_xor_si256(bytes, _mm256_set1_epi16('0' * 0x101));
}

FAULTLINE_AVX2_INLINE __m256i last_bytes(unsigned count) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(kLastBytes.data() + count));
}

/// Returns a bit for each byte that is no digit, the highest for the last byte.
FAULTLINE_AVX2_INLINE std::uint32_t others_of(__m256i digits) {
  const __m256i is_digit = _mm256_cmpeq_epi8(_mm256_min_epu8(digits, _mm256_set1_epi16(9 * 0x101)), digits);
  return ~static_cast<std::uint32_t>(_mm256_movemask_epi8(is_digit));
}

/// Returns the number of 16 digits in each half.
FAULTLINE_AVX2_INLINE __m256i sixteens_of(__m256i digits) {
  const __m256i tens = _mm256_set1_epi16(10 | 1 << 8);
  const __m256i hundreds = _mm256_set1_epi32(100 | 1 << 16);
  const __m256i ten_thousands = _mm256_set1_epi32(10000 | 1 << 16);
  const __m256i fours = _mm256_madd_epi16(_mm256_maddubs_epi16(digits, tens), hundreds);
  const __m256i eights = _mm256_madd_epi16(_mm256_packus_epi32(fours, fours), ten_thousands);
  return _mm256_add_epi64(_mm256_mul_epu32(eights, _mm256_set1_epi64x(100000000)),
                          _mm256_srli_epi64(eights, 32));
}

/// Returns the highest bit for a minus, 0 for anything else; without a comparison, which would be slower.
FAULTLINE_AVX2_INLINE std::uint64_t sign_bit_of(char c) {
  constexpr std::uint64_t kHighest = std::uint64_t{1} << 63;
  return (static_cast<std::uint64_t>(static_cast<unsigned char>(c ^ '-')) - 1) & kHighest;
}

/// Digits with a decimal sign among them: mantissa / 10^decimals. The mantissa is `upper` * 10^16 + `lower`.
struct Decimal {
  std::uint64_t sign_bit = 0;
  unsigned digits = 0, decimals = 0;
  std::uint64_t upper = 0;
  __m128i lower{};  ///< in its lower half

  bool fits() const { return upper <= kMostUpper; }
  FAULTLINE_AVX2_INLINE std::uint64_t mantissa() const {
    return upper * 10000000000000000 + static_cast<std::uint64_t>(_mm_cvtsi128_si64(lower));
  }
};

/// Reads [-]digits with a decimal sign anywhere that fit into kWidth bytes; false for anything else.
FAULTLINE_AVX2_INLINE bool read_decimal(const char* begin, const char* end, char sign, Decimal& decimal) {
  const std::uint64_t sign_bit = sign_bit_of(*begin);
  const auto total = static_cast<unsigned>(end - begin - 1) - static_cast<unsigned>(sign_bit >> 63);
  const __m256i digits = digits_at(end - kWidth);
  const std::uint32_t others = others_of(digits);
  const unsigned decimals = _lzcnt_u32(others);
  const unsigned whole = _lzcnt_u32(static_cast<std::uint32_t>(std::uint64_t{others} << (decimals + 1)));
  const bool is_decimal = (total - 1 < kWidth - 2) & (whole + decimals == total) &
                          (end[-1 - static_cast<std::ptrdiff_t>(decimals)] == sign);
  if (!is_decimal) [[unlikely]]
    return false;
  // Digits before the decimal sign move up by one byte, over it.
  const __m256i moved = digits_at(end - kWidth - 1);
  const __m256i joint = _mm256_blendv_epi8(moved, digits, last_bytes(decimals));
  const __m256i sixteens = sixteens_of(_mm256_and_si256(joint, last_bytes(total)));
  decimal = {sign_bit, total, decimals,
             static_cast<std::uint64_t>(_mm_cvtsi128_si64(_mm256_castsi256_si128(sixteens))),
             _mm256_extracti128_si256(sixteens, 1)};
  return true;
}

/// Returns mantissa / 10^decimals if both are exact doubles.
FAULTLINE_AVX2_INLINE double quotient_of(const Decimal& decimal) {
  // A number below 2^52 with these bits above it is the double 2^52 + number.
  constexpr double kTwoTo52 = 4503599627370496.0;
  const __m128i above = _mm_set1_epi64x(std::bit_cast<std::int64_t>(kTwoTo52));
  const double mantissa = _mm_cvtsd_f64(_mm_castsi128_pd(_mm_or_si128(decimal.lower, above))) - kTwoTo52;
  // The divisor takes the sign, so that -0 is correct too.
  const auto divisor = std::bit_cast<std::uint64_t>(kPowersOfTen[decimal.decimals]) | decimal.sign_bit;
  return mantissa / std::bit_cast<double>(divisor);
}

/// Rounds mantissa / 10^decimals to the nearest double by the method of Eisel and Lemire; false if that needs
/// more than one product of 64 bits, about once in several hundred. The mantissa is not 0.
FAULTLINE_AVX2_INLINE bool round_decimal(std::uint64_t mantissa, const Decimal& decimal, double& value) {
  using Double = fast_float::binary_format<double>;
  constexpr std::uint64_t kLowBits = 0x1ff;  // below the kept bits and the rounding bit
  const auto zeros = static_cast<int>(_lzcnt_u64(mantissa));
  const int exponent = -static_cast<int>(decimal.decimals);
  const int entry = 2 * (exponent - fast_float::powers::smallest_power_of_five);
  const unsigned __int128 product =
      static_cast<unsigned __int128>(mantissa << zeros) * fast_float::powers::power_of_five_128[entry];
  const auto high = static_cast<std::uint64_t>(product >> 64);
  const auto low = static_cast<std::uint64_t>(product);
  if (((high & kLowBits) == kLowBits) | (low + 1 <= 2)) [[unlikely]]
    return false;
  const int top = static_cast<int>(high >> 63);
  const std::uint64_t kept = high >> (top + 9);
  const int power = fast_float::detail::power(exponent) + top - zeros - Double::minimum_exponent();
  // The leading kept bit adds 1 to the power; so does a carry.
  value = std::bit_cast<double>(((static_cast<std::uint64_t>(power - 1) << Double::mantissa_explicit_bits()) +
                                 ((kept + (kept & 1)) >> 1)) |
                                decimal.sign_bit);
  return true;
}

/// Computes the double nearest to mantissa * 10^exponent; false when that takes more than 128 bits.
FAULTLINE_AVX2 inline bool scale(std::uint64_t mantissa, int exponent, std::uint64_t sign_bit,
                                 double& value) {
  using Double = fast_float::binary_format<double>;
  const auto rounded = fast_float::compute_float<Double>(exponent, mantissa);
  if (rounded.power2 < 0) return false;
  value = std::bit_cast<double>(
      rounded.mantissa | static_cast<std::uint64_t>(rounded.power2) << Double::mantissa_explicit_bits() |
      sign_bit);
  return true;
}

/// Reads a decimal with an exponent of one to three digits.
FAULTLINE_AVX2 inline bool read_scientific(const char* begin, const char* end, char sign, double& value) {
  constexpr int kMostDigits = 3;
  const char* p = end;
  int exponent = 0;
  for (int weight = 1; p > begin && end - p < kMostDigits && p[-1] >= '0' && p[-1] <= '9'; weight *= 10)
    exponent += weight * (*--p - '0');
  if (p == end || p == begin) return false;
  const bool negative = p[-1] == '-';
  if (negative || p[-1] == '+') --p;
  if (p == begin || (p[-1] != 'e' && p[-1] != 'E') || p - 1 == begin) return false;
  Decimal decimal;
  if (!read_decimal(begin, p - 1, sign, decimal) || !decimal.fits()) return false;
  return scale(decimal.mantissa(), (negative ? -exponent : exponent) - static_cast<int>(decimal.decimals),
               decimal.sign_bit, value);
}

[[gnu::noinline]] FAULTLINE_AVX2 inline bool read_other(const char* begin, const char* end, char sign,
                                                        double& value) {
  return read_scientific(begin, end, sign, value) || faultline::read_number(begin, end, sign, value);
}

/// Reads as faultline::read_number() does; kNumberMargin bytes must be readable on both sides.
FAULTLINE_AVX2_INLINE bool read_number(const char* begin, const char* end, char sign, double& value) {
  Decimal decimal;
  if (read_decimal(begin, end, sign, decimal)) [[likely]] {
    if (decimal.digits <= kExactDigits) {
      value = quotient_of(decimal);
      return true;
    }
    const std::uint64_t mantissa = decimal.mantissa();
    if (decimal.fits() && mantissa != 0 && round_decimal(mantissa, decimal, value)) [[likely]]
      return true;
  }
  return read_other(begin, end, sign, value);
}

}  // namespace faultline::avx2
