// SPDX-License-Identifier: MIT
#include "lib/evidence/watch/slow_watch.hpp"

#include <cmath>

#include "lib/core/distributions.hpp"

namespace faultline {
namespace {

constexpr double kFar = 2.0;  // normal ranges: farther is a fault
// What passes sooner is no state of the machine: a day's lost rows and offsets pass for friction for a while.
constexpr double kLasting_s = 5.0;

}  // namespace

SlowWatch::SlowWatch(const MotionModel& model) {
  for (std::size_t s = 0; s < model.slow.size(); ++s)
    if (model.slow[s].kind == SlowKind::friction)
      courses_.push_back({model.slow[s], 2 * model.joints() + static_cast<int>(s)});
}

void SlowWatch::take(const GaussianState& state, double time_s) {
  for (Course& course : courses_)
    follow(course, state.mean[course.index], std::sqrt(state.p(course.index, course.index)), time_s);
}

void SlowWatch::follow(Course& course, double value, double std, double time_s) {
  const double least = value - kNormal95 * std, range = course.state.normal_range();
  if (std::isnan(course.within_s) || !(least > 0.0)) course.within_s = time_s;
  if (!(least > range)) {
    course = {course.state, course.index, course.within_s};
    return;
  }
  if (std::isnan(course.left_s)) course.left_s = time_s;
  if (!(least > kFar * range))
    course.far_s = kNever;
  else if (std::isnan(course.far_s))
    course.far_s = time_s;
  if (course.fault < 0 && time_s - course.far_s >= kLasting_s) {
    course.fault = static_cast<int>(faults_.size());
    faults_.push_back({{course.state, value, std}, course.within_s, course.left_s, time_s, time_s});
  }
  if (course.fault < 0) return;
  SlowFault& fault = faults_[course.fault];
  fault.end_s = time_s;
  if (value > fault.estimate.value) fault.estimate = {course.state, value, std};
}

}  // namespace faultline
