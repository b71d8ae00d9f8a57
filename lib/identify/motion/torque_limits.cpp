// SPDX-License-Identifier: MIT
#include "lib/identify/motion/torque_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "lib/core/make_issue.hpp"

namespace faultline {
namespace {

constexpr double kSame = 1e-9;        // of the value: the same number
constexpr double kLimitShare = 0.04;  // of the rows at one value that nothing goes beyond

std::string channel(int joint) { return fmt::format("tau{}", joint + 1); }

}  // namespace

/// For the larger of two values; the smaller ones are seen with the other sign.
void TorqueLimits::Extreme::see(double v) {
  const double margin = kSame * std::max(std::abs(v), std::abs(value));
  if (rows > 0 && v < value - margin) return;
  if (rows == 0 || v > value + margin) {
    value = v;
    rows = 0;
  }
  ++rows;
}

void TorqueLimits::add(const RawStretch& s) {
  high_.resize(s.joints());
  low_.resize(s.joints());
  rows_ += s.rows();
  for (int j = 0; j < s.joints(); ++j)
    for (int k = 0; k < s.rows(); ++k) {
      high_[j].see(s.tau(j, k));
      low_[j].see(-s.tau(j, k));
    }
}

Issues TorqueLimits::issues() const {
  Issues out;
  for (std::size_t j = 0; j < high_.size(); ++j) {
    const int joint = static_cast<int>(j);
    if (high_[j].value == -low_[j].value) {
      out.add(make_issue("constant_torque", Severity::warning,
                         fmt::format("tau{} never changes: is it the right column?", joint + 1),
                         channel(joint)));
      continue;
    }
    for (const auto& [extreme, sign] : {std::pair{high_[j], 1.0}, std::pair{low_[j], -1.0}})
      if (static_cast<double>(extreme.rows) > kLimitShare * static_cast<double>(rows_) &&
          extreme.value != 0.0)
        out.add(
            make_issue("torque_limit", Severity::warning,
                       fmt::format("tau{} stands at its limit of {:g} in {:.0f} % of the rows: a torque "
                                   "cut off by the drive or by the log is not what moved the robot",
                                   joint + 1, sign * extreme.value,
                                   100.0 * static_cast<double>(extreme.rows) / static_cast<double>(rows_)),
                       channel(joint)));
  }
  return out;
}

}  // namespace faultline
