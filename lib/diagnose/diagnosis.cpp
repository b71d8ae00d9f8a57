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

const char* to_string(DecidedBy decided_by) {
  switch (decided_by) {
    case DecidedBy::agreement:
      return "agreement";
    case DecidedBy::cases:
      return "cases";
    case DecidedBy::evidence:
      return "evidence";
    case DecidedBy::criterion:
      return "criterion";
    case DecidedBy::actuator:
      return "actuator";
    case DecidedBy::control_law:
      return "control_law";
    case DecidedBy::tracking:
      return "tracking";
    case DecidedBy::abstained:
      return "abstained";
  }
  return "abstained";
}

}  // namespace faultline
