// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"
#include "lib/model/model_text.hpp"
#include "tests/explain/explained_scara.hpp"

namespace faultline {
namespace {

ExplainModel model() {
  ExplainModel out{testing::scara_model(), evidence_limits({})};
  out.limits.nats[3] = 123.25;
  return out;
}

TEST(ExplainModelJson, AModelReadBackExplainsALogToTheLastBit) {
  const ExplainModel first = model();
  const ExplainModel second = explain_model_from_json(explain_model_to_json(first), "m");
  EXPECT_EQ(second.limits.nats, first.limits.nats);
  EXPECT_EQ(explain_model_to_json(second), explain_model_to_json(first));
  const UniformLog log =
      testing::on_grid(testing::simulate_closed_form(testing::of_day(2), testing::run_of(9)));
  const LogFit a(log, std::get<BalanceModel>(first.robot)), b(log, std::get<BalanceModel>(second.robot));
  EXPECT_EQ(a.healthy().log_likelihood, b.healthy().log_likelihood);
  EXPECT_EQ(a.healthy().day, b.healthy().day);
}

TEST(ExplainModelJson, PartsThatDoNotFitTogetherAreRefused) {
  for (const char* place : {"/balance/theta", "/balance/day_variance", "/balance/torque_rms",
                            "/balance/setting/friction_width", "/balance/rigid/joints", "/balance/noise"}) {
    nlohmann::json json = explain_model_to_json(model());
    nlohmann::json& list = json[nlohmann::json::json_pointer(place)];
    list.erase(list.size() - 1);
    EXPECT_THROW(explain_model_from_json(json, "m"), Error) << place;
  }
}

}  // namespace
}  // namespace faultline
