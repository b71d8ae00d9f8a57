// SPDX-License-Identifier: MIT
#include "lib/log/log_source.hpp"

namespace faultline {

Log read_all(LogSource& source) {
  Log all, segment;
  while (source.next(segment)) append(all, segment);
  return all;
}

}  // namespace faultline
