// SPDX-License-Identifier: MIT
#include "lib/log/recorder/corrected_source.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/core/random.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {
namespace {

constexpr double kStep_s = 0.01;
constexpr double kNoise = 1e-4;

/// Three joints in motion, measured with noise; the first goes round and round.
Log moving(int rows = 800) {
  Random random(5);
  Log log;
  log.q.resize(3), log.dq.resize(3), log.tau.resize(3);
  for (int i = 0; i < rows; ++i) {
    const double t = kStep_s * i;
    log.time.push_back(t);
    for (int j = 0; j < 3; ++j) {
      const double rate = 1.0 + j, q = j == 0 ? 0.4 + 1.5 * t : std::sin(rate * t + j);
      const double dq = j == 0 ? 1.5 : rate * std::cos(rate * t + j);
      log.q[j].push_back(q + kNoise * random.normal());
      log.dq[j].push_back(dq + 10.0 * kNoise * random.normal());
      log.tau[j].push_back(5.0 * q + 10.0 * kNoise * random.normal());
    }
  }
  return log;
}

template <typename Change>
void change_measured(Log& log, Change change) {
  for (JointSignals* signals : {&log.q, &log.dq, &log.tau})
    for (std::vector<double>& joint : *signals) change(joint);
}

struct Mended {
  Log log;
  Issues issues;
  std::int64_t rows_read = 0;
};

Mended mend(const Log& log, int segment_rows = 4096, std::vector<bool> slides = {}) {
  MemorySource recorded(log, "log", segment_rows);
  const auto source = corrected(recorded, std::move(slides));
  Mended out;
  out.log = read_all(*source);
  out.issues = source->issues();
  out.rows_read = log.rows();
  return out;
}

/// Rows of which every position, velocity and torque is missing.
int rows_without_values(Log& log) {
  int count = 0;
  for (int i = 0; i < log.rows(); ++i) {
    bool has_value = false;
    change_measured(log, [&](std::vector<double>& v) { has_value = has_value || !std::isnan(v[i]); });
    count += !has_value;
  }
  return count;
}

/// A missing value is not equal to itself; this makes it comparable.
JointSignals comparable(JointSignals signals) {
  for (std::vector<double>& joint : signals)
    for (double& value : joint)
      if (std::isnan(value)) value = 1e9;
  return signals;
}

double turned(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

TEST(CorrectedSource, AHealthyLogPassesUnchanged) {
  const Log log = moving();
  const Mended out = mend(log);
  EXPECT_EQ(out.log.q, log.q);
  EXPECT_EQ(out.log.time, log.time);
  EXPECT_TRUE(out.issues.empty());
}

TEST(CorrectedSource, AWrappedAngleIsUnwrappedAndTheIssueNamesTheRow) {
  const Log whole = moving();
  Log log = whole;
  for (double& q : log.q[0]) q = turned(q);
  const Mended out = mend(log);
  for (int i = 0; i < log.rows(); ++i) ASSERT_NEAR(out.log.q[0][i], whole.q[0][i], 1e-9);
  const Issue* issue = out.issues.find("angle_unwrapped", "q1");
  ASSERT_NE(issue, nullptr);
  const auto beyond = [](double q) { return q > std::numbers::pi; };
  EXPECT_EQ(issue->first_row,
            std::find_if(whole.q[0].begin(), whole.q[0].end(), beyond) - whole.q[0].begin() + 1);
  EXPECT_EQ(issue->count, 2);
}

TEST(CorrectedSource, AnAngleFromZeroToOneTurnIsUnwrappedAlsoWithoutVelocities) {
  const Log whole = moving();
  Log log = whole;
  log.dq.clear();
  for (double& q : log.q[0]) q = q - 2.0 * std::numbers::pi * std::floor(q / (2.0 * std::numbers::pi));
  const Mended out = mend(log);
  for (int i = 0; i < log.rows(); ++i) ASSERT_NEAR(out.log.q[0][i], whole.q[0][i], 1e-9);
}

TEST(CorrectedSource, SparseRowsWithoutVelocitiesAreNotUnwrapped) {
  Log log;
  log.time = {0, 1, 2, 3};
  log.q = {{1.5, -2.9, 2.9, -2.0}};
  EXPECT_EQ(mend(log).log.q, log.q);
}

TEST(CorrectedSource, ASlidingJointIsNotUnwrapped) {
  Log log = moving();
  for (double& q : log.q[0]) q = turned(q);
  EXPECT_EQ(mend(log, 4096, {true, false, false}).log.q, log.q);
}

TEST(CorrectedSource, RowsInWhichAllJointsFreezeInMotionLoseTheirValues) {
  Log log = moving();
  change_measured(log, [](std::vector<double>& v) { std::fill_n(v.begin() + 300, 60, v[299]); });
  Mended out = mend(log);
  EXPECT_EQ(out.log.time, log.time);
  EXPECT_EQ(rows_without_values(out.log), 60);
  const Issue* issue = out.issues.find("recorder_stopped");
  ASSERT_NE(issue, nullptr);
  EXPECT_EQ(issue->first_row, 301);
  EXPECT_EQ(issue->count, 60);
  EXPECT_EQ(out.rows_read, out.log.rows() + out.issues.rows_dropped());
}

TEST(CorrectedSource, AStuckEncoderOfOneJointIsNotAStoppedRecorder) {
  Log log = moving();
  std::fill_n(log.q[1].begin() + 300, 200, log.q[1][299]);
  std::fill_n(log.dq[1].begin() + 300, 200, log.dq[1][299]);
  const Mended out = mend(log);
  EXPECT_EQ(out.log.q, log.q);
  EXPECT_TRUE(out.issues.empty());
}

TEST(CorrectedSource, ARobotAtRestIsNotAStoppedRecorder) {
  Log log = moving();
  for (std::vector<double>& joint : log.q) std::fill(joint.begin() + 300, joint.end(), joint[299]);
  for (std::vector<double>& joint : log.dq) std::fill(joint.begin() + 300, joint.end(), 0.0);
  for (std::vector<double>& joint : log.tau) std::fill(joint.begin() + 300, joint.end(), 0.5);
  const Mended out = mend(log);
  EXPECT_EQ(out.log.q, log.q);
  EXPECT_TRUE(out.issues.empty());
}

TEST(CorrectedSource, RowsThatAFasterLoggerRepeatsAreKept) {
  Log log = moving();
  change_measured(log, [](std::vector<double>& v) {
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = v[i - i % 5];
  });
  EXPECT_EQ(mend(log).log.rows(), log.rows());
}

TEST(CorrectedSource, RowsThatBecomeZeroAtOnceLoseTheirValues) {
  Log log = moving();
  change_measured(log, [](std::vector<double>& v) { std::fill_n(v.begin() + 300, 40, 0.0); });
  Mended out = mend(log);
  EXPECT_EQ(out.log.time, log.time);
  EXPECT_EQ(rows_without_values(out.log), 40);
  const Issue* issue = out.issues.find("rows_blank");
  ASSERT_NE(issue, nullptr);
  EXPECT_EQ(issue->first_row, 301);
  EXPECT_EQ(out.rows_read, out.log.rows() + out.issues.rows_dropped());
}

TEST(CorrectedSource, ARobotThatComesToRestAtZeroIsKept) {
  Log log = moving(200);
  for (int i = 0; i < log.rows(); ++i)
    for (int j = 0; j < 3; ++j) {
      const double left = std::max(1.0 - 0.01 * i, 0.0);
      log.q[j][i] = left * left, log.dq[j][i] = -2.0 * left, log.tau[j][i] = left;
    }
  EXPECT_EQ(mend(log).log.rows(), log.rows());
}

TEST(CorrectedSource, RowsCutOutUnderClosedTimeStampsBecomeAGap) {
  Log log = moving();
  change_measured(log, [](std::vector<double>& v) { v.erase(v.begin() + 300, v.begin() + 500); });
  log.time.resize(600);
  const Mended out = mend(log);
  const Issue* issue = out.issues.find("rows_cut_out");
  ASSERT_NE(issue, nullptr);
  EXPECT_EQ(issue->first_row, 301);
  EXPECT_GT(out.log.time[300] - out.log.time[299], 5.5 * kStep_s);
  EXPECT_EQ(out.rows_read, out.log.rows() + out.issues.rows_dropped());
}

TEST(CorrectedSource, ABlockThatIsTwiceInTheLogIsUsedOnce) {
  Log log = moving();
  change_measured(log, [](std::vector<double>& v) {
    const std::vector<double> block(v.begin() + 300, v.begin() + 500);
    v.insert(v.begin() + 500, block.begin(), block.end());
  });
  for (int i = 800; i < 1000; ++i) log.time.push_back(kStep_s * i);
  const Mended out = mend(log);
  EXPECT_EQ(out.log.rows(), 800);
  EXPECT_EQ(out.log.q, moving().q);
  const Issue* issue = out.issues.find("block_repeated");
  ASSERT_NE(issue, nullptr);
  EXPECT_EQ(issue->first_row, 501);
  EXPECT_EQ(issue->rows_dropped, 200);
}

TEST(CorrectedSource, AJumpOfThePositionOfOneJointIsKept) {
  Log log = moving();
  for (int i = 300; i < log.rows(); ++i) log.q[1][i] += 0.3;
  const Mended out = mend(log);
  EXPECT_EQ(out.log.q, log.q);
  EXPECT_TRUE(out.issues.empty());
}

TEST(CorrectedSource, TwoJointsThatSwapTheirSignalsAreNamedWithTheRow) {
  Log log = moving();
  for (JointSignals* signals : {&log.q, &log.dq, &log.tau})
    std::swap_ranges((*signals)[0].begin() + 300, (*signals)[0].end(), (*signals)[2].begin() + 300);
  const Mended out = mend(log);
  const Issue* issue = out.issues.find(kChangedColumns);
  ASSERT_NE(issue, nullptr);
  EXPECT_EQ(issue->severity, Severity::severe);
  EXPECT_EQ(issue->first_row, 301);
  EXPECT_NE(issue->message.find("joints 1 and 3 are swapped"), std::string::npos);
  EXPECT_EQ(out.log.rows(), log.rows());
}

TEST(CorrectedSource, BordersOfSegmentsChangeNothing) {
  Log log = moving();
  for (double& q : log.q[0]) q = turned(q);
  change_measured(log, [](std::vector<double>& v) {
    std::fill_n(v.begin() + 100, 50, v[99]);
    std::fill_n(v.begin() + 200, 40, 0.0);
    v.erase(v.begin() + 300, v.begin() + 400);
    const std::vector<double> block(v.begin() + 400, v.begin() + 500);
    v.insert(v.begin() + 500, block.begin(), block.end());
  });
  const Mended whole = mend(log);
  EXPECT_EQ(whole.issues.all().size(), 5u);
  for (const int rows : {1, 2, 7, 64, 301}) {
    const Mended cut = mend(log, rows);
    EXPECT_EQ(cut.log.time, whole.log.time) << rows;
    EXPECT_EQ(comparable(cut.log.q), comparable(whole.log.q)) << rows;
    ASSERT_EQ(cut.issues.all().size(), whole.issues.all().size()) << rows;
    for (std::size_t i = 0; i < cut.issues.all().size(); ++i)
      EXPECT_EQ(cut.issues.all()[i].message, whole.issues.all()[i].message) << rows;
  }
}

TEST(CorrectedSource, AfterRewindTheLogIsTheSame) {
  Log log = moving();
  change_measured(log, [](std::vector<double>& v) { std::fill_n(v.begin() + 300, 40, 0.0); });
  MemorySource recorded(log);
  const auto source = corrected(recorded);
  const Log first = read_all(*source);
  source->rewind();
  EXPECT_TRUE(source->issues().empty());
  EXPECT_EQ(comparable(read_all(*source).q), comparable(first.q));
  EXPECT_EQ(source->issues().find("rows_blank")->count, 40);
}

}  // namespace
}  // namespace faultline
