// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "lib/log/log.hpp"

namespace faultline {

/// Rows whose joint channels all are as in the row before though their time is another: a logger that is
/// faster than what it reads.
struct RepeatedRowCount {
  std::int64_t rows = 0;       ///< all of them, those of a robot at rest too
  std::int64_t held = 0;       ///< in stretches so short that the joints moved on right after
  std::int64_t longest = 0;    ///< in one stretch
  std::int64_t first_row = 0;  ///< of a short stretch, from 1; 0 for none
};

/// Of all joint channels together, and of the positions alone.
struct RepeatedRowCounts {
  RepeatedRowCount all, positions;
  /// Rows in which some positions change and others do not, as those of coarse encoders do.
  std::int64_t mixed = 0;
};

class RepeatedRowCheck {
 public:
  void add(const Log& segment);
  RepeatedRowCounts result() const;

 private:
  /// Rows with the same values one after the other.
  struct Runs {
    void take(bool repeats);
    void end();

    std::int64_t row = 0, run = 0;
    RepeatedRowCount found{};
  };
  std::vector<double> last_, now_;
  Runs all_, positions_;
  std::int64_t mixed_ = 0;
};

}  // namespace faultline
