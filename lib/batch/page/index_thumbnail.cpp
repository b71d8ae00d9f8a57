// SPDX-License-Identifier: MIT
#include "lib/batch/page/index_thumbnail.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

constexpr double kWidth = 160.0;
constexpr int kLane = 6;

struct Scale {
  double start_s, end_s;
  double x(double time_s) const {
    return std::clamp((time_s - start_s) / (end_s - start_s), 0.0, 1.0) * kWidth;
  }
};

std::string bar(const char* kind, double from, double to, int y) {
  return fmt::format("<rect{} x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"4\"/>", kind, from, y,
                     std::max(to - from, 1.0));
}

std::string fault_bars(const FaultEvent& fault, const Scale& scale, int y) {
  if (!std::isfinite(fault.onset_s)) return "";
  const double onset = scale.x(fault.onset_s);
  const double alarm = std::isfinite(fault.alarm_s) ? std::max(scale.x(fault.alarm_s), onset) : onset;
  const double end = std::isfinite(fault.end_s) ? scale.x(fault.end_s) : kWidth;
  const std::string before = alarm - onset >= 0.1 ? bar("", onset, alarm, y) : "";
  return before + bar(" class=\"f\"", alarm, end, y);
}

}  // namespace

std::string index_thumbnail(const BatchRow& row) {
  const Scale scale{row.start_s, row.end_s};
  if (!(scale.end_s > scale.start_s)) return "";
  int first = 1, last = std::max(row.joints, 1);
  for (const FaultEvent& fault : row.faults) {
    first = std::min(first, fault.label.joint);
    last = std::max(last, fault.label.joint);
  }
  std::string lanes, bars;
  for (int joint = first; joint <= last; ++joint)
    lanes += fmt::format("M0 {}h{}", (joint - first) * kLane + 3, kWidth);
  for (const FaultEvent& fault : row.faults)
    bars += fault_bars(fault, scale, (fault.label.joint - first) * kLane + 1);
  return fmt::format("<svg class=\"t\" viewBox=\"0 0 160 {}\" aria-hidden=\"true\"><path d=\"{}\"/>{}</svg>",
                     (last - first + 1) * kLane, lanes, bars);
}

}  // namespace faultline
