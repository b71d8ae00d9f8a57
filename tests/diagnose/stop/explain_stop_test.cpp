// SPDX-License-Identifier: MIT
// What a diagnosis says of the moments before a stop, on simulated runs whose truth is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lib/core/error.hpp"
#include "lib/diagnose/diagnose.hpp"
#include "lib/report/text.hpp"
#include "tests/learn/small_robot.hpp"

namespace faultline {
namespace {

constexpr double kForEver = std::numeric_limits<double>::infinity();
constexpr double kPeriod_s = 0.01;
/// Largest error of the time of a first sign: a fault shows when the joint moves against it.
constexpr double kSignError_s = 0.15;

/// A log that is cut around a stop: `before_s` of a run up to it, then `after_s` in which the brakes hold the
/// joint and the drive is off.
Log cut_at_stop(const Log& run, double stop_s, double before_s, double after_s) {
  Log out;
  for (int k = 0; k < run.rows(); ++k)
    if (run.time[k] >= stop_s - before_s - 1e-9 && run.time[k] <= stop_s + 1e-9)
      append(out, slice(run, k, k + 1));
  const Log last = slice(out, out.rows() - 1, out.rows());
  for (int k = 1; k * kPeriod_s <= after_s; ++k) {
    Log row = last;
    row.time[0] += k * kPeriod_s;
    row.dq[0][0] = row.tau[0][0] = 0.0;
    append(out, row);
  }
  return out;
}

class Stop : public testing::Test {
 protected:
  static void SetUpTestSuite() { learned_ = new Learned(learn_small()); }
  static void TearDownTestSuite() { delete learned_; }

  static Log run_with(std::vector<SimulatedFault> faults, std::uint64_t seed = 77) {
    SimulationSpec spec = small_run(14.0);
    spec.faults = std::move(faults);
    return simulate(small_robot(), spec, seed).log;
  }
  static Diagnosis asked(const Log& log, double stop_s, int segment_rows = 4096) {
    MemorySource source(log, "run.csv", segment_rows);
    DiagnoseOptions options;
    options.stop = StopQuestion{stop_s, ""};
    return diagnose(source, learned_->model, learned_->cases, options);
  }

  static Learned* learned_;
};

Learned* Stop::learned_ = nullptr;

const StopChannel& channel_of(const StopAnswer& stop, StopSignal signal) {
  return *std::find_if(stop.channels.begin(), stop.channels.end(),
                       [&](const StopChannel& channel) { return channel.signal == signal; });
}

TEST_F(Stop, ALostTorqueIsTheFirstSignOfTheStopAfterIt) {
  constexpr double kOnset_s = 6.0, kStop_s = 7.0;
  const Log run = run_with({{FaultKind::torque_loss, 1_joint, kOnset_s, kForEver, 0.5, 0.0}});
  const Diagnosis diagnosis = asked(cut_at_stop(run, kStop_s, 5.0, 1.0), kStop_s);
  ASSERT_TRUE(diagnosis.stop);
  const StopAnswer& stop = *diagnosis.stop;
  ASSERT_TRUE(stop.first_sign);
  EXPECT_NEAR(stop.first_sign->time_s, kOnset_s, kSignError_s);
  EXPECT_EQ(stop.first_sign->joint, 1_joint);
  EXPECT_EQ(stop.leading.joint, 1_joint);
  EXPECT_GT(stop.leading.times_healthy, 3.0);
  EXPECT_EQ(channel_of(stop, StopSignal::torque_balance).state, SignalState::changed);
  ASSERT_TRUE(stop.short_log);
  EXPECT_NEAR(stop.short_log->before_s, 5.0, 2.0 * kPeriod_s);
  EXPECT_NEAR(stop.short_log->after_s, 1.0, 2.0 * kPeriod_s);
}

TEST_F(Stop, TheFirstSignIsNeverAfterTheStop) {
  const Log run = run_with({{FaultKind::collision, 1_joint, 6.0, 6.1, 40.0, 0.0}});
  for (const double stop_s : {6.2, 6.3, 6.8}) {
    const Diagnosis diagnosis = asked(cut_at_stop(run, stop_s, 5.0, 1.0), stop_s);
    ASSERT_TRUE(diagnosis.stop->first_sign) << stop_s;
    EXPECT_LE(diagnosis.stop->first_sign->time_s, stop_s) << stop_s;
    EXPECT_NEAR(diagnosis.stop->first_sign->time_s, 6.0, kSignError_s) << stop_s;
  }
}

TEST_F(Stop, AStopWithoutACauseInTheLogHasNoSign) {
  for (const std::uint64_t seed : {31, 32, 33, 34})
    for (const double stop_s : {6.0, 7.3, 8.9, 11.1}) {
      const Diagnosis diagnosis = asked(cut_at_stop(run_with({}, seed), stop_s, 5.0, 0.0), stop_s);
      const StopAnswer& stop = *diagnosis.stop;
      EXPECT_FALSE(stop.first_sign) << seed << ", " << stop_s;
      EXPECT_LT(stop.leading.times_healthy, 1.5) << seed << ", " << stop_s;
      const SeenChange& torque = stop.seen.front();
      EXPECT_TRUE(torque.could_be_found && torque.by_this_log && std::isfinite(torque.size));
    }
}

TEST_F(Stop, BrakesAfterTheStopAreNoSignBeforeIt) {
  const Diagnosis diagnosis = asked(cut_at_stop(run_with({}, 31), 7.3, 5.0, 1.0), 7.3);
  EXPECT_FALSE(diagnosis.stop->first_sign);
  EXPECT_EQ(channel_of(*diagnosis.stop, StopSignal::torque_balance).state, SignalState::normal);
}

TEST_F(Stop, ATorqueOfTheSeenSizeIsSeen) {
  constexpr double kStop_s = 7.3;
  const Log healthy = run_with({}, 31);
  const double size = asked(cut_at_stop(healthy, kStop_s, 5.0, 0.0), kStop_s).stop->seen.front().size;
  for (const double factor : {1.5, 0.3}) {
    Log log = cut_at_stop(healthy, kStop_s, 5.0, 0.0);
    for (int k = 0; k < log.rows(); ++k)
      if (log.time[k] > kStop_s - 1.0) log.tau[0][k] += factor * size;
    EXPECT_EQ(channel_of(*asked(log, kStop_s).stop, StopSignal::torque_balance).state == SignalState::changed,
              factor > 1.0)
        << factor;
  }
}

TEST_F(Stop, AFaultThatEndedLongBeforeIsNoSignButAFinding) {
  const Log run = run_with({{FaultKind::collision, 1_joint, 4.0, 4.1, 40.0, 0.0}});
  const Diagnosis diagnosis = asked(run, 9.0);
  EXPECT_FALSE(diagnosis.stop->first_sign);
  ASSERT_EQ(diagnosis.stop->findings.size(), 1u);
  EXPECT_NEAR(diagnosis.stop->findings[0].before_s, 5.0, kSignError_s);
  EXPECT_GT(diagnosis.stop->findings[0].ended_before_s, 4.0);
  EXPECT_TRUE(diagnosis.stop->findings[0].by_rows_before);
}

TEST_F(Stop, AFaultAfterTheStopIsNotBeforeIt) {
  const Log run = run_with({{FaultKind::torque_loss, 1_joint, 9.0, kForEver, 0.5, 0.0}});
  const Diagnosis diagnosis = asked(run, 6.0);
  EXPECT_EQ(diagnosis.faults.size(), 1u);
  EXPECT_TRUE(diagnosis.stop->findings.empty());
  EXPECT_FALSE(diagnosis.stop->first_sign);
}

TEST_F(Stop, AMomentOutsideOfTheLogIsRefusedWithItsRange) {
  const Log run = run_with({});
  for (const double stop_s : {-1.0, 20.0}) try {
      asked(run, stop_s);
      ADD_FAILURE() << stop_s;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::usage);
      EXPECT_NE(error.message().find("from 0.000 s to 14.000 s"), std::string::npos) << error.message();
    }
}

TEST_F(Stop, MomentsAtTheVeryBeginAndEndAreAnswered) {
  const Log run = run_with({});
  for (const double stop_s : {0.0, 0.02, 0.7, 14.0}) EXPECT_TRUE(asked(run, stop_s).stop) << stop_s;
}

TEST_F(Stop, TheVerdictAndTheFaultsAreThoseWithoutTheQuestion) {
  const Log run = run_with({{FaultKind::torque_loss, 1_joint, 6.0, kForEver, 0.5, 0.0}});
  Diagnosis with = asked(run, 8.0);
  with.stop.reset();
  MemorySource source(run, "run.csv");
  EXPECT_EQ(render_json(with), render_json(diagnose(source, learned_->model, learned_->cases)));
}

TEST_F(Stop, SegmentBordersChangeNoByte) {
  const Log run = run_with({{FaultKind::torque_loss, 1_joint, 6.0, kForEver, 0.5, 0.0}});
  EXPECT_EQ(render_json(asked(run, 8.0)), render_json(asked(run, 8.0, 37)));
}

}  // namespace
}  // namespace faultline
