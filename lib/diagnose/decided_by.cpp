// SPDX-License-Identifier: MIT
#include "lib/diagnose/decided_by.hpp"

namespace faultline {

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

ConfidenceSource confidence_source(DecidedBy decided_by) {
  if (decided_by == DecidedBy::agreement) return ConfidenceSource::networks;
  return decided_by == DecidedBy::cases ? ConfidenceSource::votes : ConfidenceSource::likelihood;
}

}  // namespace faultline
