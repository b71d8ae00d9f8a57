// SPDX-License-Identifier: MIT
// When faults end: what is over by itself ends with it, what stays ends with the log.
#include <gtest/gtest.h>

#include "lib/diagnose/diagnose.hpp"
#include "tests/learn/small_robot.hpp"

namespace faultline {
namespace {

constexpr double kForEver = std::numeric_limits<double>::infinity();
constexpr double kRun_s = 14.0;
constexpr double kLate_s = 0.3;  // an end is told to so much

class FaultEnd : public testing::Test {
 protected:
  static void SetUpTestSuite() { learned_ = new Learned(learn_small()); }
  static void TearDownTestSuite() { delete learned_; }

  static std::vector<FaultFinding> found(std::vector<SimulatedFault> faults) {
    SimulationSpec spec = small_run(kRun_s);
    spec.faults = std::move(faults);
    MemorySource source(simulate(small_robot(), spec, 77).log, "run.csv");
    return diagnose(source, learned_->model, learned_->cases).faults;
  }

  static Learned* learned_;
};

Learned* FaultEnd::learned_ = nullptr;

TEST_F(FaultEnd, AShortCollisionEndsWhenItIsOver) {
  for (const double duration_s : {0.05, 0.15}) {
    const auto faults = found({{FaultKind::collision, 1_joint, 5.0, 5.0 + duration_s, 40.0, 0.0}});
    ASSERT_EQ(faults.size(), 1u) << duration_s;
    EXPECT_NEAR(faults[0].end_s, 5.0 + duration_s, kLate_s) << duration_s;
  }
}

TEST_F(FaultEnd, ALastingFaultEndsWithTheLog) {
  for (const auto& [kind, size] : {std::pair{FaultKind::sensor_bias, 0.02}, {FaultKind::torque_loss, 0.5}}) {
    const auto faults = found({{kind, 1_joint, 5.0, kForEver, size, 0.0}});
    ASSERT_EQ(faults.size(), 1u) << to_string(kind);
    EXPECT_NEAR(faults[0].end_s, kRun_s, kLate_s) << to_string(kind);
  }
}

}  // namespace
}  // namespace faultline
