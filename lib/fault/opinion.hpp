// SPDX-License-Identifier: MIT
#pragma once

#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// What one judge, such as a network, says of an episode.
struct Opinion {
  FaultLabel label;
  double confidence = 0.0;  ///< 0 to 1

  bool operator==(const Opinion&) const = default;
};

/// The opinions of the two networks.
struct Opinions {
  Opinion mlp;
  Opinion rbfn;

  bool operator==(const Opinions&) const = default;
};

}  // namespace faultline
