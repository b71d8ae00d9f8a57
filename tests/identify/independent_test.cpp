// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <iostream>

#include "lib/identify/identify.hpp"
#include "lib/log/log_source.hpp"
#include "tests/identify/shared_data.hpp"

namespace faultline {
namespace {

struct Group {
  const char* name;
  std::vector<const char*> files;
  double m1, m2, m3, l1, l2;
  TorqueTiming timing;
  double bound_percent;
};

const std::vector<Group> kGroups = {
    {"indust 1 kHz", {"t_000", "t_001", "t_002"}, 8.0, 5.0, 2.5, 0.35, 0.3, TorqueTiming::unknown, 0.2},
    {"light 500 Hz", {"t_016", "t_017", "t_018"}, 2.5, 1.5, 0.6, 0.25, 0.2, TorqueTiming::unknown, 0.2},
    {"bench1 100 Hz", {"t_032", "t_033", "t_034"}, 1.0, 0.8, 0.5, 1.0, 0.8, TorqueTiming::held, 0.2},
    {"bench0 clean", {"t_060", "t_061", "t_062"}, 1.0, 0.8, 0.5, 1.0, 0.8, TorqueTiming::held, 1.0},
    {"bench0 noisy", {"t_071", "t_072", "t_073"}, 1.0, 0.8, 0.5, 1.0, 0.8, TorqueTiming::held, 1.0},
};

Identification identify_group(const Group& group, const std::string& folder, TorqueTiming timing) {
  std::vector<MemorySource> sources;
  for (const char* file : group.files)
    sources.emplace_back(testing::read_rrp_csv(folder + "/independent-simulation/" + file + ".csv"), file);
  std::vector<LogSource*> logs;
  for (auto& source : sources) logs.push_back(&source);
  Robot robot = preset_robot("RRP");
  robot.known["l1"] = {group.l1, 0.0};
  robot.chain.length[0] = group.l1;
  robot.log.torque_between_samples = timing;
  return identify(logs, robot);
}

void print(const Group& group, const Identification& id, const std::vector<double>& truth, double seconds) {
  std::cout << group.name << " (" << to_string(id.method) << ", " << to_string(id.status) << ", " << seconds
            << " s)";
  for (std::size_t k = 0; k < truth.size(); ++k)
    std::cout << "  " << id.base_parameters[k].name << " "
              << 100.0 * (id.base_parameters[k].value / truth[k] - 1.0) << " +- "
              << 100.0 * id.base_parameters[k].std / truth[k] << " %";
  std::cout << "\n   ";
  for (std::size_t k = 4; k < id.base_parameters.size(); ++k)
    std::cout << id.base_parameters[k].name << " " << id.base_parameters[k].value << " +- "
              << id.base_parameters[k].std << "  ";
  std::cout << "\n    ";
  for (const auto& e : id.physical_parameters)
    std::cout << e.name << " " << e.value << " +- " << e.std << " " << e.why_not << "  ";
  std::cout << "\n    condition " << id.condition_number << " R2";
  for (double r2 : id.fit_r2) std::cout << " " << r2;
  std::cout << " noise";
  for (double s : id.q_noise) std::cout << " " << s;
  for (double s : id.dq_noise) std::cout << " " << s;
  std::cout << " " << id.reason << "\n";
}

TEST(IdentifyIndependentSimulation, GivesTheBaseParametersFromHealthyLogs) {
  const std::string folder = testing::shared_data();
  if (folder.empty()) return;
  for (const Group& group : kGroups) {
    const double l1 = group.l1, l2 = group.l2, m1 = group.m1, m2 = group.m2, m3 = group.m3;
    const std::vector<double> truth = {l1 * l1 * (m1 / 3 + m2 + m3), l2 * l2 * (m2 / 3 + m3),
                                       l1 * l2 * (m2 / 2 + m3), m3};
    const auto begin = std::chrono::steady_clock::now();
    const Identification id = identify_group(group, folder, group.timing);
    print(group, id, truth, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    for (std::size_t k = 0; k < truth.size(); ++k)
      EXPECT_NEAR(id.base_parameters[k].value / truth[k], 1.0, group.bound_percent / 100.0) << group.name;
  }
}

}  // namespace
}  // namespace faultline
