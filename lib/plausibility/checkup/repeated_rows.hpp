// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "lib/log/log.hpp"

namespace faultline {

/// Count of rows whose joint channels all equal those of the row before, at another time: the logger is
/// faster than its source.
struct RepeatedRowCount {
  std::int64_t rows = 0;       ///< all, also those of a robot at rest
  std::int64_t held = 0;       ///< in short stretches, directly after which joints moved
  std::int64_t longest = 0;    ///< in one stretch
  std::int64_t first_row = 0;  ///< of the first short stretch, from 1; 0 for none
};

/// For all joint channels together, and for the positions alone.
struct RepeatedRowCounts {
  RepeatedRowCount all, positions;
  /// Rows in which some positions change and others do not, as with coarse encoders.
  std::int64_t mixed = 0;
};

class RepeatedRowCheck {
 public:
  void add(const Log& segment);
  RepeatedRowCounts result() const;

 private:
  /// Stretches of successive rows with the same values.
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
