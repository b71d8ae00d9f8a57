// SPDX-License-Identifier: MIT
#pragma once

#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// What one network says a fault is: the label of its largest output.
struct Opinion {
  FaultLabel label;
  double confidence = 0.0;  ///< 0 to 1

  bool operator==(const Opinion&) const = default;
};

/// What both say, the paper's dual classification.
struct Opinions {
  Opinion mlp;
  Opinion rbfn;

  bool operator==(const Opinions&) const = default;
};

}  // namespace faultline
