// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <string>

#include "lib/core/json/json_fields.hpp"
#include "lib/core/number_text.hpp"
#include "lib/diagnose/diagnosis.hpp"

namespace faultline {

/// A finding as an event of a log, as an index of many logs and a golden log store it.
struct FaultEvent {
  FaultLabel label;
  double onset_s = std::numeric_limits<double>::quiet_NaN();
  double alarm_s = std::numeric_limits<double>::quiet_NaN();
  double end_s = std::numeric_limits<double>::quiet_NaN();
  double confidence = 0.0;      ///< 0 to 1
  int run = 0;                  ///< as FaultFinding::run
  double clock_offset_s = 0.0;  ///< as FaultFinding::clock_offset_s
};

inline FaultEvent event_of(const FaultFinding& f) {
  return {f.label, f.onset_s, f.alarm_s, f.end_s, f.confidence, f.run, f.clock_offset_s};
}

/// Formats a time of a fault: "12.345 s", in a log with several runs "12.345 s (1.234 s on its clock)".
/// `Fault` is a FaultEvent or a FaultFinding.
template <typename Fault>
std::string clock_words(const Fault& fault, double time_s, double sample_period_s) {
  const std::string time = time_text(time_s, sample_period_s);
  if (fault.run == 0 || !std::isfinite(time_s)) return time;
  return time + " (" + time_text(time_s - fault.clock_offset_s, sample_period_s) + " on its clock)";
}

/// Formats the onset: "12.345 s", in a log with several runs "12.345 s (run 2, 1.234 s on its clock)".
/// `Fault` is a FaultEvent or a FaultFinding.
template <typename Fault>
std::string onset_words(const Fault& fault, double sample_period_s) {
  const std::string onset = time_text(fault.onset_s, sample_period_s);
  if (fault.run == 0) return onset;
  return onset + " (run " + std::to_string(fault.run) + ", " +
         time_text(fault.onset_s - fault.clock_offset_s, sample_period_s) + " on its clock)";
}

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
