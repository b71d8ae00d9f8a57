// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace faultline {

/// How the cells of a table's last column are written: enough to tell that the end of the file may have cut
/// one.
class LastCells {
 public:
  void add(std::string_view cell, char decimal);
  /// Whether the cell is shorter than the others, so that it may be the beginning of a longer one: it has
  /// fewer decimals where all have the same number, else fewer digits than the longest (15 digits are all
  /// that count), or an exponent with fewer, or none where others have one. Never when no other cell was
  /// seen.
  bool is_shorter(std::string_view cell, char decimal) const;

 private:
  bool has_fewer_digits(std::string_view cell, char decimal) const;

  long numbers_ = 0;
  bool missing_ = false, texts_ = false;  ///< whether there are such cells
  int fewest_decimals_ = 0, most_decimals_ = 0;
  int most_digits_ = 0;
  long exponents_ = 0;
  int fewest_exponent_digits_ = 0;
};

}  // namespace faultline
