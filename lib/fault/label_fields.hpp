// SPDX-License-Identifier: MIT
#pragma once

#include "lib/core/json/json_fields.hpp"
#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// Reading throws Error(usage) for an unknown kind.
void fields(auto& v, MaybeConst<FaultLabel> auto& label) {
  v.named("kind", label.kind, fault_kind_from);
  v("joint", label.joint);
}

void fields(auto& v, MaybeConst<Opinion> auto& opinion) {
  fields(v, opinion.label);
  v("confidence", opinion.confidence);
}

void fields(auto& v, MaybeConst<Opinions> auto& opinions) {
  v("mlp", opinions.mlp);
  v("rbfn", opinions.rbfn);
}

}  // namespace faultline
