// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace faultline {

/// Whether the positions of the rows are those of two publishers in turn: each row is near the one before the
/// last, not near the last one.
class AlternatingRows {
 public:
  /// The positions of all joints, always in the same order.
  void add(const std::vector<double>& position);
  /// Of the rows so far, most.
  bool alternate() const;

 private:
  std::vector<double> last_, one_before_;
  std::int64_t rows_ = 0, alternating_ = 0;
};

}  // namespace faultline
