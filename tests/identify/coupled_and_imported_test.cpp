// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/identify/identify.hpp"
#include "lib/log/log_source.hpp"
#include "lib/log/transformed/coupled_source.hpp"
#include "lib/robot/dynamics.hpp"
#include "lib/robot/urdf/urdf.hpp"
#include "tests/identify/closed_form_scara.hpp"
#include "tests/robot/assorted_chains.hpp"

/// Identification of robots whose logs or files come in other forms.
namespace faultline {
namespace {

using Vector = JointVector;

const Log& run() {
  static const Log log = testing::simulate_closed_form({}, {});
  return log;
}

Identification identified(LogSource& source, Robot robot) {
  LogSource* logs[] = {&source};
  robot.log.torque_between_samples = TorqueTiming::held;
  return identify(logs, robot);
}

Robot nominal() {
  Robot robot = preset_robot("RRP");
  robot.known["l1"] = {1.0, 0.0};
  return robot;
}

const Identification& plain() {
  static const Identification id = [] {
    MemorySource source(run(), "log");
    return identified(source, nominal());
  }();
  return id;
}

/// Largest difference of torques at random states, relative to the largest torque there.
double difference(const Robot& a, const Robot& b) {
  Random random(80);
  double worst = 0.0, largest = 0.0;
  for (int k = 0; k < 100; ++k) {
    const Vector q = draw(random, 3, 2.0), dq = draw(random, 3, 2.0), ddq = draw(random, 3, 5.0);
    const Vector tau = inverse_dynamics(a.chain, q, dq, ddq);
    worst = std::max(worst, (inverse_dynamics(b.chain, q, dq, ddq) - tau).cwiseAbs().maxCoeff());
    largest = std::max(largest, tau.cwiseAbs().maxCoeff());
  }
  return worst / largest;
}

TEST(CoupledLogs, GiveTheSameRobotAsLogsOfTheJoints) {
  Eigen::MatrixXd coupling(3, 3);
  coupling << 1, 0, 0, -1, 0.5, 0, 0, 0.02, 2;
  const auto source = coupled(std::make_unique<MemorySource>(uncoupled(run(), coupling), "drives"), coupling);
  EXPECT_LT(difference(plain().robot, identified(*source, nominal()).robot), 1e-6);
}

TEST(IdentifiedRobots, MoveIdenticallyAfterAnExportToUrdf) {
  EXPECT_LT(difference(plain().robot, robot_from_urdf(urdf_text(plain().robot), "identified.urdf")), 1e-12);
}

TEST(ImportedRobots, AreIdentifiedLikeTheirPreset) {
  std::string text = urdf_text(preset_robot("RRP"));
  text.erase(text.find("  <faultline>"), text.find("</faultline>") + 12 - text.find("  <faultline>"));
  const Robot imported = robot_from_urdf(text, "arm.urdf");
  ASSERT_EQ(imported.shapes[0], LinkShape::general);
  MemorySource source(run(), "log");
  const Identification id = identified(source, imported);
  for (const double r2 : id.fit_r2) EXPECT_GT(r2, 0.9);
  EXPECT_LT(difference(plain().robot, id.robot), 0.02);
}

}  // namespace
}  // namespace faultline
