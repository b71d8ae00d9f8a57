// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"
#include "lib/log/log_source.hpp"
#include "lib/residual/learn_residual.hpp"
#include "lib/residual/residuals.hpp"
#include "tests/support/bench_motion.hpp"

namespace faultline {
namespace {

ResidualGenerator small_generator(ResidualKind kind) {
  MemorySource source(bench_log(bench_robot(), {.duration_s = 40.0, .noise = 1e-3}));
  LogSource* logs[] = {&source};
  return learn_residual_generator(logs, bench_robot(), 0.3,
                                  {.kind = kind, .hidden = {6}, .max_iterations = 4})
      .generator;
}

TEST(ResidualJson, ReadsBackToTheSameResidualsBitForBit) {
  const Log log = bench_log(bench_robot(), {.duration_s = 10.0, .noise = 1e-3, .seed = 3});
  for (ResidualKind kind : {ResidualKind::mlp, ResidualKind::physics, ResidualKind::hybrid}) {
    const ResidualGenerator generator = small_generator(kind);
    const nlohmann::json json = generator;
    const ResidualGenerator back =
        residual_generator_from_json(nlohmann::json::parse(json.dump()), generator.chain, "model.json");
    ResidualState one, two;
    const Residuals before = compute_residuals(generator, log, one),
                    after = compute_residuals(back, log, two);
    EXPECT_TRUE(before.velocity == after.velocity && before.position == after.position) << to_string(kind);
    EXPECT_TRUE(before.torque == after.torque && before.ratio == after.ratio) << to_string(kind);
  }
}

TEST(ResidualJson, WrongContentIsRefusedWithItsPlace) {
  const ResidualGenerator generator = small_generator(ResidualKind::mlp);
  const nlohmann::json good = generator;
  const auto fails = [&](const char* pointer, nlohmann::json value) {
    nlohmann::json bad = good;
    bad[nlohmann::json::json_pointer(pointer)] = std::move(value);
    try {
      residual_generator_from_json(bad, generator.chain, "model.json");
    } catch (const Error& error) {
      return error.code() == ErrorCode::input && error.where().find("model.json") == 0;
    }
    return false;
  };
  EXPECT_TRUE(fails("/kind", "magic"));
  EXPECT_TRUE(fails("/shape/joints", 4));
  EXPECT_TRUE(fails("/shape/stride", 9));
  EXPECT_TRUE(fails("/shape/step_s", 0.0));
  EXPECT_TRUE(fails("/healthy/velocity_rms/1", 0.0));
  EXPECT_TRUE(fails("/uses_mean_torque", false));
  EXPECT_TRUE(fails("/turns", nlohmann::json::array({false})));
  EXPECT_TRUE(fails("/mlp/layers", nlohmann::json::array()));
}

Residuals given(std::initializer_list<double> velocity) {
  Residuals r;
  const int n = static_cast<int>(velocity.size());
  r.velocity = Eigen::Map<const Eigen::RowVectorXd>(velocity.begin(), n);
  r.position = 0.5 * r.velocity;
  r.torque = r.tau = r.velocity;
  r.time = Eigen::VectorXd::LinSpaced(n, 0.0, 0.1 * (n - 1));
  for (int i = 0; i < n; ++i) r.row.push_back(i);
  return r;
}

TEST(ResidualSummary, GivesRmsPeakAndItsTime) {
  ResidualSummary whole, part(0.05, 0.15), empty(5.0, 6.0);
  const Residuals r = given({1.0, -2.0, std::numeric_limits<double>::quiet_NaN(), 2.0});
  for (ResidualSummary* summary : {&whole, &part, &empty}) summary->add(r);
  EXPECT_DOUBLE_EQ(whole.joints()[0].velocity_rms, std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(whole.joints()[0].velocity_peak, 2.0);
  EXPECT_DOUBLE_EQ(whole.joints()[0].velocity_peak_s, 0.1);
  EXPECT_DOUBLE_EQ(whole.joints()[0].position_rms, std::sqrt(0.75));
  EXPECT_DOUBLE_EQ(part.joints()[0].velocity_rms, 2.0);
  EXPECT_TRUE(std::isnan(empty.joints()[0].velocity_rms));
}

}  // namespace
}  // namespace faultline
