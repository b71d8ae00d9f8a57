// SPDX-License-Identifier: MIT
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "lib/core/elementary/double_double.hpp"
#include "lib/core/elementary/elementary.hpp"

namespace faultline::elementary {
namespace {

/// An angle as `quadrant` right angles plus the rest high + low, within half a right angle of zero.
struct RightAngles {
  int quadrant;  ///< modulo 4
  double high, low;
};

using Word = std::uint64_t;
using TwoWords = unsigned __int128;
/// A whole number of 256 bits, lowest word first.
using Wide = std::array<Word, 4>;

/// The binary digits of 2 / pi after the point (Payne and Hanek 1983).
constexpr std::array<Word, 22> kTwoOverPi{
    0xa2f9836e4e441529, 0xfc2757d1f534ddc0, 0xdb6295993c439041, 0xfe5163abdebbc561, 0xb7246e3a424dd2e0,
    0x06492eea09d1921c, 0xfe1deb1cb129a73e, 0xe88235f52ebb4484, 0xe99c7026b45f7e41, 0x3991d639835339f4,
    0x9c845f8bbdf9283b, 0x1ff897ffde05980f, 0xef2f118b5a0a6d1f, 0x6d367ecf27cb09b7, 0x4f463f669e5fea2d,
    0x7527bac7ebe5f17b, 0x3d0739f78a5292ea, 0x6bfb5fb11f8d5d08, 0x56033046fc7b6bab, 0xf0cfbc209af4361d,
    0xa9e391615ee61b08, 0x6599855f14a06800};
constexpr int kWindow = 192;  // digits needed for one angle

/// Returns kWindow digits of 2 / pi from that one on (0 is the first after the point), lowest word first.
std::array<Word, 3> digits_from(int first) {
  const int word = first / 64, shift = first % 64;
  std::array<Word, 3> out;
  for (int k = 0; k < 3; ++k) {
    const Word upper = kTwoOverPi[word + k], lower = kTwoOverPi[word + k + 1];
    out[2 - k] = shift == 0 ? upper : (upper << shift) | (lower >> (64 - shift));
  }
  return out;
}

Wide product_of(Word factor, const std::array<Word, 3>& digits) {
  Wide out{};
  TwoWords carry = 0;
  for (int k = 0; k < 3; ++k) {
    carry += static_cast<TwoWords>(factor) * digits[k];
    out[k] = static_cast<Word>(carry);
    carry >>= 64;
  }
  out[3] = static_cast<Word>(carry);
  return out;
}

Wide shifted_up(const Wide& value, int bits) {
  const int words = bits / 64, rest = bits % 64;
  Wide out{};
  for (int k = 3; k >= words; --k) {
    out[k] = value[k - words] << rest;
    if (rest > 0 && k > words) out[k] |= value[k - words - 1] >> (64 - rest);
  }
  return out;
}

Wide negative(Wide value) {
  Word carry = 1;
  for (Word& word : value) {
    word = ~word + carry;
    carry = carry == 1 && word == 0 ? 1 : 0;
  }
  return value;
}

/// Returns value / 2^256 to 106 bits or more.
DoubleDouble fraction(Wide value) {
  int zeros = 0;
  for (int k = 3; k >= 0 && value[k] == 0; --k) zeros += 64;
  if (zeros == 256) return {};
  zeros += std::countl_zero(value[3 - zeros / 64]);
  value = shifted_up(value, zeros);
  const Word first = value[3] >> 11, second = (value[3] << 42 | value[2] >> 22) & ((Word{1} << 53) - 1);
  return {std::ldexp(static_cast<double>(first), -53 - zeros),
          std::ldexp(static_cast<double>(second), -106 - zeros)};
}

/// Reduces any finite angle, in whole numbers: exact to 2^-135 before it is rounded to the two doubles.
RightAngles right_angles_of_any(double x) {
  constexpr DoubleDouble kQuarterTurn{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
  int exponent = 0;
  const double mantissa = std::frexp(std::abs(x), &exponent);
  const auto whole = static_cast<Word>(std::ldexp(mantissa, 53));
  exponent -= 53;                                     // |x| = whole 2^exponent
  const int first = exponent > 2 ? exponent - 2 : 0;  // digits before it make whole turns
  const int point = kWindow + first - exponent;       // binary places of the product, 194 to 246
  const Wide product = product_of(whole, digits_from(first));
  // The bits below the point move to the top, and the two above it.
  const Wide above = shifted_up(product, 254 - point);
  int quadrant = static_cast<int>(above[3] >> 62);
  Wide rest = shifted_up(above, 2);
  const bool rounds_up = rest[3] >> 63 == 1;
  if (rounds_up) {
    ++quadrant;
    rest = negative(rest);
  }
  DoubleDouble angle = fraction(rest) * kQuarterTurn;
  if (rounds_up) angle = -angle;
  if (std::signbit(x)) return {-quadrant & 3, -angle.high, -angle.low};
  return {quadrant & 3, angle.high, angle.low};
}

constexpr double kHalfRightAngle = 0x1.921fb54442d18p-1;
constexpr double kCosLargest = std::numeric_limits<double>::max();
constexpr double kMedium = 1e6;    // up to there the parts of a right angle times the quadrant are exact
constexpr double kTiny = 0x1p-27;  // the sine rounds to x below it
constexpr double kClose =
    0x1p-13;  // nearer to a whole right angle those parts do not suffice or are out of order

/// Returns the right angles of |x| below kMedium (Cody and Waite 1980).
[[gnu::always_inline]] inline RightAngles right_angles(double x) {
  constexpr double kRounder = 0x1.8p52;
  constexpr double kPerRightAngle = 0x1.45f306dc9c883p-1;
  constexpr double kFirst = 0x1.921fb544p+0, kSecond = 0x1.0b4611a6p-34, kThird = 0x1.3198a2e037073p-69;
  const double shifted = x * kPerRightAngle + kRounder, count = shifted - kRounder;
  const double most = x - count * kFirst;
  if (std::abs(most) < kClose) return right_angles_of_any(x);
  const DoubleDouble rest = sum_of_ordered(most, -count * kSecond);
  const DoubleDouble angle = sum_of_ordered(rest.high, rest.low - count * kThird);
  return {static_cast<int>(count) & 3, angle.high, angle.low};
}

/// Returns the right angles of a finite x beyond half a right angle.
[[gnu::always_inline]] inline RightAngles reduced(double x) {
  return std::abs(x) < kMedium ? right_angles(x) : right_angles_of_any(x);
}

[[gnu::always_inline]] inline double sine_of(double x, double more) {
  const double z = x * x, z2 = z * z;
  const double tail =
      (-0x1.5555555555555p-3 + z * 0x1.1111111111110p-7) +
      z2 * ((-0x1.a01a01a019933p-13 + z * 0x1.71de3a54600cap-19) +
            z2 * ((-0x1.ae645411d76a9p-26 + z * 0x1.61217e4ef55f8p-33) - z2 * 0x1.ab1764e7b2047p-41));
  return x + (x * z * tail + more * (1.0 - 0.5 * z));
}

[[gnu::always_inline]] inline double cosine_of(double x, double more) {
  const double z = x * x, z2 = z * z, half = 0.5 * z, most = 1.0 - half;
  const double tail =
      (0x1.5555555555555p-5 - z * 0x1.6c16c16c16c16p-10) +
      z2 * ((0x1.a01a01a019d08p-16 - z * 0x1.27e4fb7712996p-22) +
            z2 * ((0x1.1eed8deb2dd23p-29 - z * 0x1.9394b9651e761p-37) + z2 * 0x1.ab77f828b3725p-45));
  return most + (((1.0 - most) - half) + (z2 * tail - x * more));
}

/// Returns NaN for infinities and NaN.
double of_other(double x) { return x - x; }

}  // namespace

double sin(double x) {
  const double size = std::abs(x);
  if (size <= kHalfRightAngle) return size < kTiny ? x : sine_of(x, 0.0);
  if (!(size <= kCosLargest)) return of_other(x);
  const RightAngles a = reduced(x);
  const double value = a.quadrant & 1 ? cosine_of(a.high, a.low) : sine_of(a.high, a.low);
  return a.quadrant & 2 ? -value : value;
}

double cos(double x) {
  const double size = std::abs(x);
  if (size <= kHalfRightAngle) return cosine_of(x, 0.0);
  if (!(size <= kCosLargest)) return of_other(x);
  const RightAngles a = reduced(x);
  const double value = a.quadrant & 1 ? sine_of(a.high, a.low) : cosine_of(a.high, a.low);
  return (a.quadrant + 1) & 2 ? -value : value;
}

SinCos sin_cos(double x) {
  const double size = std::abs(x);
  if (size <= kHalfRightAngle) return {size < kTiny ? x : sine_of(x, 0.0), cosine_of(x, 0.0)};
  if (!(size <= kCosLargest)) return {of_other(x), of_other(x)};
  const RightAngles a = reduced(x);
  const double s = sine_of(a.high, a.low), c = cosine_of(a.high, a.low);
  const double sine = a.quadrant & 1 ? c : s, cosine = a.quadrant & 1 ? s : c;
  return {a.quadrant & 2 ? -sine : sine, (a.quadrant + 1) & 2 ? -cosine : cosine};
}

}  // namespace faultline::elementary
