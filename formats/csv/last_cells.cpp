// SPDX-License-Identifier: MIT
#include "formats/csv/last_cells.hpp"

#include <algorithm>
#include <cctype>

#include "formats/csv/csv_fields.hpp"

namespace faultline {
namespace {

constexpr int kDigitsOfADouble = 15;  // that a double always preserves
constexpr int kExponentDigits = 2;    // that the usual libraries write at least

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// The parts of a number in text.
struct Digits {
  int significant = 0;  ///< without leading zeros
  int decimals = 0;     ///< after the decimal sign; -1 without one
  int exponent = -1;    ///< -1 without one
  bool ends_in_digit = false;
};

Digits digits_of(std::string_view cell, char decimal) {
  Digits digits{.decimals = -1};
  for (const char c : cell) {
    if (c == 'e' || c == 'E') {
      digits.exponent = 0;
    } else if (c == decimal) {
      digits.decimals = 0;
    } else if (is_digit(c) && digits.exponent >= 0) {
      ++digits.exponent;
    } else if (is_digit(c)) {
      digits.decimals += digits.decimals >= 0;
      digits.significant += c != '0' || digits.significant > 0;
    }
  }
  digits.ends_in_digit = !cell.empty() && is_digit(cell.back());
  return digits;
}

/// True for words such as "true" and "inf", which are read as numbers.
bool is_word(std::string_view cell) { return std::none_of(cell.begin(), cell.end(), is_digit); }

}  // namespace

void LastCells::add(std::string_view cell, char decimal) {
  const CellKind kind = read_cell(cell, decimal).kind;
  missing_ = missing_ || kind == CellKind::missing;
  texts_ = texts_ || kind == CellKind::text;
  if (kind != CellKind::number || is_word(cell)) return;
  const Digits digits = digits_of(cell, decimal);
  fewest_decimals_ = numbers_ == 0 ? digits.decimals : std::min(fewest_decimals_, digits.decimals);
  most_decimals_ = numbers_ == 0 ? digits.decimals : std::max(most_decimals_, digits.decimals);
  most_digits_ = std::max(most_digits_, digits.significant);
  ++numbers_;
  if (digits.exponent < 0) return;
  fewest_exponent_digits_ =
      exponents_ == 0 ? digits.exponent : std::min(fewest_exponent_digits_, digits.exponent);
  ++exponents_;
}

bool LastCells::is_shorter(std::string_view cell, char decimal) const {
  const CellKind kind = read_cell(cell, decimal).kind;
  if (kind == CellKind::missing) return numbers_ > 0 && !missing_;
  if (kind == CellKind::text) return numbers_ > 0 && !texts_;
  return numbers_ > 0 && !is_word(cell) && has_fewer_digits(cell, decimal);
}

bool LastCells::has_fewer_digits(std::string_view cell, char decimal) const {
  const Digits digits = digits_of(cell, decimal);
  if (!digits.ends_in_digit) return true;
  if (digits.exponent < 0 && exponents_ > 0) return true;
  if (digits.exponent >= 0)
    return digits.exponent < (exponents_ > 0 ? fewest_exponent_digits_ : kExponentDigits);
  const bool fixed = fewest_decimals_ == most_decimals_ && most_decimals_ >= 0;
  if (fixed) return digits.decimals < most_decimals_;
  return digits.significant < std::min(most_digits_, kDigitsOfADouble);
}

}  // namespace faultline
