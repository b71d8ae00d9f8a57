// SPDX-License-Identifier: MIT
#include "lib/explain/evidence_course.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace faultline {
namespace {

const EvidenceCourse kRising{{1.0, 2.0, 3.0, 4.0}, {5.0, 50.0, 120.0, 110.0}};

TEST(EvidenceCourse, TheAlarmIsTheFirstTimeBeyondTheThreshold) {
  EXPECT_EQ(kRising.alarm_s(40.0), 2.0);
  EXPECT_EQ(kRising.alarm_s(100.0), 3.0);
  EXPECT_EQ(kRising.alarm_s(1e6), 4.0) << "it never passes: the last time";
  EXPECT_TRUE(std::isnan(EvidenceCourse{}.alarm_s(1.0)));
}

TEST(EvidenceCourse, CoursesAreTracedAtCommonTimes) {
  const EvidenceCourse later{{2.5, 3.5}, {7.0, 9.0}};
  const FaultLabel loss{FaultKind::torque_loss, 1_joint}, lock{FaultKind::locked, 2_joint};
  const EvidenceTrace trace = trace_of({loss, lock}, {kRising, later}, 3.2);
  EXPECT_EQ(trace.time, (std::vector<double>{1.0, 2.0, 2.5, 3.0}));
  ASSERT_EQ(trace.curves.size(), 2u);
  EXPECT_EQ(trace.curves[0].label, loss);
  EXPECT_EQ(trace.curves[0].ratio, (std::vector<double>{5.0, 50.0, 50.0, 120.0}));
  EXPECT_TRUE(std::isnan(trace.curves[1].ratio[1])) << "before its onset";
  EXPECT_EQ(trace.curves[1].ratio[3], 7.0);
}

TEST(EvidenceCourse, ALongTraceIsThinned) {
  EvidenceCourse course;
  for (int k = 0; k < 5000; ++k) {
    course.time_s.push_back(0.001 * k);
    course.nats.push_back(k);
  }
  EXPECT_LE(trace_of({{FaultKind::locked, 1_joint}}, {course}, 1e9).time.size(), 121u);
}

}  // namespace
}  // namespace faultline
