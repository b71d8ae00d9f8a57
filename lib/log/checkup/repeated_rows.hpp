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

class RepeatedRowCheck {
 public:
  void add(const Log& segment);
  RepeatedRowCount result() const;

 private:
  void end();

  std::vector<double> last_, now_;
  std::int64_t row_ = 0, run_ = 0;
  RepeatedRowCount found_;
};

}  // namespace faultline
