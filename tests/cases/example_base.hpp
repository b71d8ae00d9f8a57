// SPDX-License-Identifier: MIT
#pragma once

#include "lib/cases/case_base.hpp"
#include "lib/core/random.hpp"

namespace faultline {

/// Two features that tell three faults apart and one that is noise.
inline Case example_case(Random& random, FaultLabel label, double x, double y) {
  Case c;
  c.episode.features = {x + 0.1 * random.normal(), y + 0.1 * random.normal(), random.normal()};
  c.episode.mlp = {label, 0.9};
  c.episode.rbfn = {label, 0.8};
  c.episode.evidence = 40.0;
  c.decision = label;
  c.label = label;
  c.outcome = CaseOutcome::confirmed;
  c.origin = "simulated";
  return c;
}

inline constexpr FaultLabel kFree{FaultKind::free_swinging, 1_joint};
inline constexpr FaultLabel kLocked{FaultKind::locked, 2_joint};
inline constexpr FaultLabel kBias{FaultKind::sensor_bias, 3_joint};

/// `each` confirmed cases of each of the three faults, at (0, 0), (2, 0) and (0, 2), learned.
inline CaseBase example_base(int each = 20) {
  CaseBase base({"a", "b", "noise"});
  Random random(7);
  for (int i = 0; i < each; ++i) {
    base.retain(example_case(random, kFree, 0.0, 0.0));
    base.retain(example_case(random, kLocked, 2.0, 0.0));
    base.retain(example_case(random, kBias, 0.0, 2.0));
  }
  base.learn();
  return base;
}

}  // namespace faultline
