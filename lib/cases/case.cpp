// SPDX-License-Identifier: MIT
#include "lib/cases/case.hpp"

#include "lib/core/error.hpp"

namespace faultline {

const char* to_string(CaseOutcome outcome) {
  switch (outcome) {
    case CaseOutcome::unconfirmed:
      return "unconfirmed";
    case CaseOutcome::confirmed:
      return "confirmed";
    case CaseOutcome::rejected:
      return "rejected";
  }
  return "unconfirmed";
}

CaseOutcome case_outcome_from(const std::string& name) {
  for (const auto outcome : {CaseOutcome::unconfirmed, CaseOutcome::confirmed, CaseOutcome::rejected})
    if (name == to_string(outcome)) return outcome;
  throw Error(ErrorCode::usage, "outcome",
              "\"" + name + "\" is not an outcome; expected one of unconfirmed, confirmed, rejected");
}

}  // namespace faultline
