// SPDX-License-Identifier: MIT
#include "lib/model/twin/twin_options.hpp"

#include <fmt/format.h>

#include "lib/core/error.hpp"
#include "lib/model/twin/twin_fields.hpp"

namespace faultline {
namespace {

[[noreturn]] void bad(const std::string& key, const std::string& message) {
  throw Error(ErrorCode::usage, "TwinOptions." + key, message);
}

void check_range(const std::string& key, const DrawRange& range) {
  if (!(range.low <= range.high))
    bad(key, fmt::format("goes from {} to {}; the first number must not exceed the second", range.low,
                         range.high));
  if (range.low < 0.0) bad(key, fmt::format("begins at {}, must not be negative", range.low));
  if (range.spread == Spread::log_uniform && range.low <= 0.0)
    bad(key, fmt::format("is log-uniform from {}, must begin above 0", range.low));
}

void check_field(const std::string& key, double value) {
  if (!(value >= 0.0)) bad(key, fmt::format("is {}, must not be negative", value));
  if (key.ends_with("_share") && value > 1.0)
    bad(key, fmt::format("is {}, but a share must be at most 1", value));
}

void check_field(const std::string& key, const DrawRange& range) {
  if (range.spread != Spread::uniform || range.either_sign) bad(key, "can be uniform only");
  check_range(key, range);
}

void check_field(const std::string& key, int value) {
  if (value < 1) bad(key, fmt::format("is {}, must be at least 1", value));
}

}  // namespace

std::array<TwinFault, kFaultKinds> catalogued_twin_faults() {
  std::array<TwinFault, kFaultKinds> faults;
  for (int k = 0; k < kFaultKinds; ++k) {
    const FaultDescription& fault = describe(static_cast<FaultKind>(k));
    for (int s = 0; s < fault.size_count; ++s) faults[k].size[s] = fault.size[s].twin;
    faults[k].length_s = fault.twin_length_s;
  }
  return faults;
}

void TwinOptions::check() const {
  visit_twin_fields(*this, [](const char* key, const auto& value, const char*) { check_field(key, value); });
  if (!(control_period_s > 0.0)) bad("control_period_s", "is 0, must be above 0");
  if (shortest_move_s > longest_move_s)
    bad("shortest_move_s", fmt::format("is {}, above longest_move_s = {}", shortest_move_s, longest_move_s));
  if (onset.high > 1.0)
    bad("onset", fmt::format("ends at {}, but a share of the run must be at most 1", onset.high));
  for (int k = 0; k < kFaultKinds; ++k) {
    const std::string key = std::string("faults.") + to_string(static_cast<FaultKind>(k));
    for (const DrawRange& range : faults[k].size) check_range(key, range);
    check_range(key, faults[k].length_s);
  }
}

}  // namespace faultline
