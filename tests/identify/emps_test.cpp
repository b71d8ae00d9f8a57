// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <iostream>

#include "lib/identify/identify.hpp"
#include "lib/log/log_source.hpp"
#include "tests/identify/shared_data.hpp"

namespace faultline {
namespace {

/// Janot, Gautier, Brunot, "Data set and reference models of EMPS" (2019): M, Fv, Fc and offset of the
/// electro-mechanical positioning system, unrounded. The data set does not say how the force runs between
/// samples, so its timing is left free.
TEST(IdentifyEmps, AgreesWithPublishedParametersWithinOnePercent) {
  const std::string folder = testing::shared_data();
  if (folder.empty()) return;
  MemorySource source(testing::read_plain_csv(folder + "/emps/DATA_EMPS.csv", {1}, {}, {3}, 35.15065),
                      "emps");
  Robot robot = preset_robot("P");
  robot.chain.gravity.setZero();
  robot.known["fb1"] = robot.known["fs1"] = {0.0, 0.0};  // the published model has no such friction
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

TEST(IdentifyEmps, FrictionThatDiffersByDirectionHalvesTheError) {
  const std::string folder = testing::shared_data();
  if (folder.empty()) return;
  MemorySource source(testing::read_plain_csv(folder + "/emps/DATA_EMPS.csv", {1}, {}, {3}, 35.15065),
                      "emps");
  Robot robot = preset_robot("P");
  robot.chain.gravity.setZero();
  LogSource* logs[] = {&source};
  const Identification id = identify(logs, robot);
  for (const ModelTerm& term : id.terms)
    if (term.name == "fs_1") {
      EXPECT_TRUE(term.kept);
      EXPECT_LT(term.error_after, 0.5 * term.error_before);
    }
  EXPECT_NEAR(id.base_parameters[0].value / 95.1089, 1.0, 0.003);
  EXPECT_LT(id.robot.chain.friction[0].skew, 0.0);
}

}  // namespace
}  // namespace faultline
