// SPDX-License-Identifier: MIT
#include "lib/fault/label_text.hpp"

namespace faultline {

std::string label_text(const FaultLabel& label, const char* between) {
  const std::string kind = to_string(label.kind);
  return label.joint > 0 ? kind + between + std::to_string(label.joint) : kind;
}

}  // namespace faultline
