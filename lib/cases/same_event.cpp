// SPDX-License-Identifier: MIT
#include "lib/cases/same_event.hpp"

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

constexpr double kOneOnset_s = 0.1;  // another model may estimate another onset of the same fault

bool same_time(double a_s, double b_s) {
  return std::isnan(a_s) || std::isnan(b_s) ? std::isnan(a_s) == std::isnan(b_s)
                                            : std::abs(a_s - b_s) <= kOneOnset_s;
}

}  // namespace

bool is_same_event(const Case& a, const Case& b) {
  return !a.log_sha256.empty() && a.log_sha256 == b.log_sha256 && same_time(a.onset_s, b.onset_s) &&
         (a.decision == b.decision || a.label == b.label);
}

const Case* find_same_event(const CaseBase& base, const Case& c) {
  const auto& cases = base.cases();
  const auto found =
      std::find_if(cases.begin(), cases.end(), [&](const Case& other) { return is_same_event(other, c); });
  return found == cases.end() ? nullptr : &*found;
}

}  // namespace faultline
