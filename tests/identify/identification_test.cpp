// SPDX-License-Identifier: MIT
#include "lib/identify/identification.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <nlohmann/json.hpp>
#include <string>

#include "lib/balance/regressor.hpp"
#include "lib/core/error.hpp"
#include "lib/identify/identification_json.hpp"
#include "lib/identify/identify.hpp"
#include "lib/log/log_source.hpp"
#include "tests/identify/closed_form_scara.hpp"

namespace faultline {
namespace {

Identification identify_with(int threads) {
  MemorySource source(testing::simulate_closed_form({}, {}), "log");
  LogSource* logs[] = {&source};
  Robot robot = preset_robot("RRP");
  robot.log.torque_between_samples = TorqueTiming::held;
  robot.known["l1"] = {1.0, 0.0};
  IdentifyOptions options;
  options.threads = threads;
  return identify(logs, robot, options);
}

const Identification& identified() {
  static const Identification id = identify_with(1);
  return id;
}

/// Base parameters, then fv and fc of every joint, of a drawn robot.
Eigen::VectorXd parameters_in(const Robot& robot, const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>& lift,
                              int rigid) {
  Eigen::VectorXd links = Eigen::VectorXd::Zero(3 * (kLinkParameters + 1)), out(rigid + 6);
  for (int i = 0; i < 3; ++i)
    links.segment<kLinkParameters>(i * kLinkParameters) = to_vector(robot.chain.links[i]);
  out.head(rigid) = lift.solve(links);
  for (int j = 0; j < 3; ++j) {
    out[rigid + j] = robot.chain.friction[j].viscous;
    out[rigid + 3 + j] = robot.chain.friction[j].coulomb;
  }
  return out;
}

TEST(Identification, ThreadsDoNotChangeAByte) {
  const std::string once = to_json(identified()).dump();
  EXPECT_TRUE(once == to_json(identify_with(2)).dump());
  EXPECT_TRUE(once == to_json(identify_with(1)).dump());
}

TEST(Identification, JsonKeepsEveryBit) {
  const auto document = to_json(identified());
  const Identification again =
      identification_from_json(nlohmann::ordered_json::parse(document.dump()), "test");
  EXPECT_EQ(to_json(again).dump(), document.dump());
  EXPECT_EQ(again.estimate, identified().estimate);
  EXPECT_EQ(again.covariance, identified().covariance);
  Random one(4), other(4);
  EXPECT_EQ(draw(again, one).chain.links[1].first_moment,
            draw(identified(), other).chain.links[1].first_moment);
}

TEST(Identification, AnotherSchemaAndACutDocumentAreRefused) {
  nlohmann::ordered_json document;
  for (const char* member : {"held_out_r2", "excitation", "trend", "state"}) {
    document = to_json(identified());
    document.erase(member);
    EXPECT_THROW(identification_from_json(document, "test"), Error) << member;
  }
  document = to_json(identified());
  document["schema"] = "faultline/identification/2";
  EXPECT_THROW(identification_from_json(document, "test"), Error);
}

TEST(Identification, DrawsHaveTheEstimatedCovariance) {
  constexpr int kDraws = 4000;
  const Identification& id = identified();
  const int rigid = id.space.rigid(), count = rigid + 6;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> lift(id.space.lift);
  Random random(12);
  Eigen::MatrixXd scaled(count, kDraws);
  const Eigen::VectorXd std = (id.covariance.diagonal().head(count).array() > 0.0)
                                  .select(id.covariance.diagonal().head(count), 1.0)
                                  .cwiseSqrt();
  for (int k = 0; k < kDraws; ++k)
    scaled.col(k) =
        (parameters_in(draw(id, random), lift, rigid) - id.estimate.head(count)).cwiseQuotient(std);
  const Eigen::MatrixXd expected = std.cwiseInverse().asDiagonal() *
                                   id.covariance.topLeftCorner(count, count) *
                                   std.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd seen = scaled * scaled.transpose() / kDraws;
  EXPECT_LT(scaled.rowwise().mean().cwiseAbs().maxCoeff(), 4.0 / std::sqrt(kDraws));
  EXPECT_LT((seen - expected).cwiseAbs().maxCoeff(), 0.1);
  EXPECT_GT((expected - Eigen::MatrixXd::Identity(count, count)).cwiseAbs().maxCoeff(), 0.3);
}

}  // namespace
}  // namespace faultline
