// SPDX-License-Identifier: MIT
#include "lib/explain/evidence_course.hpp"

#include <algorithm>
#include <limits>

namespace faultline {
namespace {

constexpr std::size_t kTracedTimes = 120;  // times of a trace, at most

/// Returns the evidence at a time: that of the last row up to it; NaN before the first row.
double at(const EvidenceCourse& course, double time_s) {
  const auto after = std::upper_bound(course.time_s.begin(), course.time_s.end(), time_s);
  if (after == course.time_s.begin()) return std::numeric_limits<double>::quiet_NaN();
  return course.nats[static_cast<std::size_t>(after - course.time_s.begin() - 1)];
}

}  // namespace

double EvidenceCourse::alarm_s(double threshold) const {
  for (std::size_t k = 0; k < nats.size(); ++k)
    if (nats[k] > threshold) return time_s[k];
  return time_s.empty() ? std::numeric_limits<double>::quiet_NaN() : time_s.back();
}

EvidenceTrace trace_of(const std::vector<FaultLabel>& labels, const std::vector<EvidenceCourse>& courses,
                       double until_s) {
  EvidenceTrace out;
  std::vector<double> times;
  for (const EvidenceCourse& course : courses)
    for (const double t : course.time_s)
      if (t <= until_s) times.push_back(t);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  const std::size_t stride = times.size() / kTracedTimes + 1;
  for (std::size_t k = 0; k < times.size(); k += stride) out.time.push_back(times[k]);
  for (std::size_t c = 0; c < courses.size(); ++c) {
    EvidenceCurve& curve = out.curves.emplace_back();
    curve.label = labels[c];
    for (const double t : out.time) curve.ratio.push_back(at(courses[c], t));
  }
  return out;
}

}  // namespace faultline
