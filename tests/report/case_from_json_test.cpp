// SPDX-License-Identifier: MIT
#include "lib/report/case_from_json.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

std::string report(const std::string& features) {
  return R"({"schema": "faultline/diagnosis/1", "log": {"path": "run.csv", "sha256": "ab"}, "model": {"name": "arm"},
             "faults": [{"id": 1, "kind": "unknown", "joint": 1, "onset_s": 1.5,
               "opinions": {"mlp": {"kind": "none", "joint": null, "confidence": 0},
                            "rbfn": {"kind": "none", "joint": null, "confidence": 0}},
               "episode": {"evidence": null, "features": )" +
         features + "}}]}";
}

TEST(CaseFromJson, AFindingWithoutFeaturesBecomesACaseWithoutFeatures) {
  const Case c = case_from_json(report("{}"), "run.json", 1, {"strength", "length"});
  EXPECT_EQ(c.label, (FaultLabel{FaultKind::unknown, 1_joint}));
  EXPECT_EQ(c.onset_s, 1.5);
  EXPECT_EQ(c.robot, "arm");
  ASSERT_EQ(c.episode.features.size(), 2u);
  for (const double value : c.episode.features) EXPECT_TRUE(std::isnan(value));
}

TEST(CaseFromJson, FeaturesThatDifferFromThoseOfTheBaseAreRefused) {
  EXPECT_EQ(case_from_json(report(R"({"strength": 2})"), "run.json", 1, {"strength"}).episode.features,
            std::vector<double>{2.0});
  try {
    case_from_json(report(R"({"strength": 2})"), "run.json", 1, {"strength", "length"});
    FAIL() << "one is missing";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("\"length\""), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace faultline
