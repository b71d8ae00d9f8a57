// SPDX-License-Identifier: MIT
#pragma once

#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// Classification of a fault by one network: the label of its largest output.
struct Opinion {
  FaultLabel label;
  double confidence = 0.0;  ///< 0 to 1

  bool operator==(const Opinion&) const = default;
};

/// Classification by both networks, the paper's dual classification.
struct Opinions {
  Opinion mlp;
  Opinion rbfn;

  bool operator==(const Opinions&) const = default;
};

}  // namespace faultline
