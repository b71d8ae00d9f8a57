// SPDX-License-Identifier: MIT
#include "lib/diagnose/diagnosis.hpp"

#include <array>

namespace faultline {

const char* to_string(Verdict verdict) {
  static constexpr std::array kNames{"not_run", "healthy", "faulty", "inconclusive"};
  static_assert(kNames.size() == static_cast<std::size_t>(Verdict::inconclusive) + 1);
  return kNames[static_cast<std::size_t>(verdict)];
}

const char* to_string(DecidedBy decided_by) {
  static constexpr std::array kNames{"agreement", "cases",       "evidence", "criterion",
                                     "actuator",  "control_law", "tracking", "abstained"};
  static_assert(kNames.size() == static_cast<std::size_t>(DecidedBy::abstained) + 1);
  return kNames[static_cast<std::size_t>(decided_by)];
}

}  // namespace faultline
