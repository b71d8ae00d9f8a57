// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "lib/identify/identify.hpp"
#include "lib/log/log_source.hpp"
#include "lib/robot/robot_file.hpp"
#include "tests/identify/closed_form_scara.hpp"

namespace faultline {
namespace {

using testing::ClosedFormRun;
using testing::simulate_closed_form;

/// Three logs whose torque is held over each sample, and nobody says so.
Identification identified(std::uint64_t seed) {
  std::vector<std::unique_ptr<MemorySource>> sources;
  std::vector<LogSource*> logs;
  for (std::uint64_t log = 0; log < 3; ++log) {
    ClosedFormRun run;
    run.period_s = 0.002;
    run.duration_s = 10.0;
    run.seed = 10 * seed + log;
    sources.push_back(std::make_unique<MemorySource>(simulate_closed_form({}, run), "log"));
    logs.push_back(sources.back().get());
  }
  return identify(logs, preset_robot("RRP"));
}

bool is_late(const Identification& id) {
  return std::any_of(id.robot.torque_delay_s.begin(), id.robot.torque_delay_s.end(),
                     [](double delay) { return delay != 0.0; });
}

TEST(TorqueDelay, AHeldTorqueIsReportedWithoutADelay) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const Identification id = identified(seed);
    EXPECT_FALSE(is_late(id)) << seed;
    EXPECT_NEAR(id.robot.torque_phi.value_or(0.5), 0.0, 0.05) << seed;
  }
}

}  // namespace
}  // namespace faultline
