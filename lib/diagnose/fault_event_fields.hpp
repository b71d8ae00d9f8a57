// SPDX-License-Identifier: MIT
#pragma once

#include "lib/core/json/json_fields.hpp"
#include "lib/diagnose/fault_event.hpp"

namespace faultline {

/// The joint of a fault without a joint is null. Reading throws Error(usage) for an unknown kind.
void fields(auto& v, MaybeConst<FaultEvent> auto& event) {
  v.named("kind", event.label.kind, fault_kind_from);
  v.or_null("joint", event.label.joint);
  v("onset_s", event.onset_s);
  v("alarm_s", event.alarm_s);
  v("end_s", event.end_s);
  v("confidence", event.confidence);
  v.unless_empty("run", event.run);
  if (event.run > 0) v("clock_offset_s", event.clock_offset_s);
}

}  // namespace faultline
