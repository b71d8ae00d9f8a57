// SPDX-License-Identifier: MIT
#include "formats/bytes/work_budget.hpp"

#include "lib/core/error.hpp"

namespace faultline {

void WorkBudget::refuse() const {
  throw Error(
      ErrorCode::input, path_,
      "holds far more rows or unpacked bytes than a log of its size (over 2 us of work for each byte of "
      "the file), so reading stopped. If it is a log, unpack it first, or write it again without "
      "compression and without parts that hold no log");
}

}  // namespace faultline
