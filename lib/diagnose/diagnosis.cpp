// SPDX-License-Identifier: MIT
#include "lib/diagnose/diagnosis.hpp"

namespace faultline {

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::not_run:
      return "not_run";
    case Verdict::healthy:
      return "healthy";
    case Verdict::faulty:
      return "faulty";
    case Verdict::inconclusive:
      return "inconclusive";
  }
  return "not_run";
}

}  // namespace faultline
