// SPDX-License-Identifier: MIT
#include "lib/fault/fault_kind.hpp"

#include <fmt/format.h>

#include "lib/core/error.hpp"
#include "lib/fault/fault_catalogue.hpp"

namespace faultline {

const char* to_string(FaultKind kind) { return describe(kind).name; }

FaultKind fault_kind_from(const std::string& name) {
  std::string known;
  for (int i = 0; i < kFaultKinds; ++i) {
    const FaultKind kind = static_cast<FaultKind>(i);
    if (name == to_string(kind)) return kind;
    known += (i ? ", " : "") + std::string(to_string(kind));
  }
  throw Error(ErrorCode::usage, "fault", "\"" + name + "\" is not a fault name; expected one of " + known);
}

std::string label_text(const FaultLabel& label, const char* between) {
  const std::string kind = to_string(label.kind);
  return label.joint.is_none() ? kind : fmt::format("{}{}{}", kind, between, label.joint);
}

}  // namespace faultline
