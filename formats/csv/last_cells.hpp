// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace faultline {

/// Format of the cells in the last column of a table, to detect that the end of the file may have cut one.
class LastCells {
 public:
  void add(std::string_view cell, char decimal);
  /// True when the cell is shorter than the others and may be the beginning of a longer one: it has fewer
  /// decimals if all have the same number, else fewer digits than the longest (at most 15 count), or an
  /// exponent with fewer digits, or none if others have one. False when no other cell was seen.
  bool is_shorter(std::string_view cell, char decimal) const;

 private:
  bool has_fewer_digits(std::string_view cell, char decimal) const;

  long numbers_ = 0;
  bool missing_ = false, texts_ = false;  ///< such cells were seen
  int fewest_decimals_ = 0, most_decimals_ = 0;
  int most_digits_ = 0;
  long exponents_ = 0;
  int fewest_exponent_digits_ = 0;
};

}  // namespace faultline
