// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <iostream>

#include "lib/identify/identify.hpp"
#include "lib/log/memory_source.hpp"
#include "tests/identify/shared_data.hpp"

namespace faultline {
namespace {

/// Janot, Gautier, Brunot, "Data set and reference models of EMPS" (2019): M, Fv, Fc and offset of the
/// electro-mechanical positioning system, unrounded. The data set does not say how the force runs between
/// samples, so its timing is left free.
TEST(IdentifyEmps, PublishedParametersWithinOnePercent) {
  const std::string folder = testing::shared_data();
  if (folder.empty()) return;
  MemorySource source(testing::read_plain_csv(folder + "/emps/DATA_EMPS.csv", {1}, {}, {3}, 35.15065),
                      "emps");
  Robot robot = preset_robot("P");
  robot.chain.gravity.setZero();
  LogSource* logs[] = {&source};
  const Identification id = identify(logs, robot);
  std::cout << to_string(id.method) << " " << id.reason << " R2 " << id.fit_r2[0] << "\n";
  for (const auto& e : id.base_parameters) std::cout << e.name << " " << e.value << " +- " << e.std << "\n";
  std::cout << "width " << id.robot.chain.friction[0].width << "\n";
  const double truth[] = {95.1089, 203.5034, 20.3935, -3.1648};
  for (int k = 0; k < 4; ++k)
    EXPECT_NEAR(id.base_parameters[k].value / truth[k], 1.0, 0.01) << id.base_parameters[k].name;
  EXPECT_GE(id.fit_r2[0], 0.997);
}

}  // namespace
}  // namespace faultline
