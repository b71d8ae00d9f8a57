// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "lib/robot/dynamics.hpp"
#include "lib/robot/robot_file.hpp"
#include "lib/robot/urdf/urdf.hpp"
#include "tests/robot/assorted_chains.hpp"
#include "tests/support/chain_mechanics.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

using Vector = JointVector;

/// A joint with its child link as URDF says them, and in the words of the test.
struct Part {
  const char* type = "fixed";
  int parent = 0;  // 0 the base, else the part with that number, from 1
  Eigen::Vector3d xyz, rpy, axis;
  double mass = 0.0;
  Eigen::Vector3d centre, centre_rpy;
  Eigen::Matrix3d inertia;
};

std::string triple(const Eigen::Vector3d& v) { return fmt::format("{} {} {}", v.x(), v.y(), v.z()); }

std::string text_of(const std::vector<Part>& parts) {
  std::string text = "<?xml version=\"1.0\"?>\n<robot name=\"tree\">\n<link name=\"l0\"/>\n";
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Part& p = parts[i];
    text += fmt::format(
        "<joint name=\"j{0}\" type=\"{1}\"><parent link=\"l{2}\"/><child link=\"l{0}\"/>"
        "<origin xyz=\"{3}\" rpy=\"{4}\"/><axis xyz=\"{5}\"/></joint>\n"
        "<link name=\"l{0}\"><inertial><origin xyz=\"{6}\" rpy=\"{7}\"/><mass value=\"{8}\"/>"
        "<inertia ixx=\"{9}\" iyy=\"{10}\" izz=\"{11}\" ixy=\"{12}\" ixz=\"{13}\" iyz=\"{14}\"/>"
        "</inertial></link>\n",
        i + 1, p.type, p.parent, triple(p.xyz), triple(p.rpy), triple(p.axis), triple(p.centre),
        triple(p.centre_rpy), p.mass, p.inertia(0, 0), p.inertia(1, 1), p.inertia(2, 2), p.inertia(0, 1),
        p.inertia(0, 2), p.inertia(1, 2));
  }
  return text + "</robot>\n";
}

Eigen::Matrix3d rotation(const Eigen::Vector3d& rpy) {
  return (Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

Part random_part(Random& random, const char* type, int parent) {
  Eigen::Matrix3d root;
  root << draw3(random), draw3(random), draw3(random);
  return {type,
          parent,
          0.3 * draw3(random),
          draw3(random),
          draw3(random),
          random.uniform(0.5, 3.0),
          0.1 * draw3(random),
          draw3(random),
          0.01 * root * root.transpose()};
}

/// Six moving joints with fixed links between, behind and beside them, in frames turned at random.
std::vector<Part> random_tree() {
  Random random(60);
  std::vector<Part> parts;
  const auto add = [&](const char* type, int parent) { parts.push_back(random_part(random, type, parent)); };
  add("fixed", 0);
  add("revolute", 1);
  add("continuous", 2);
  add("fixed", 3);
  add("prismatic", 4);
  add("fixed", 3);     // beside the chain
  add("revolute", 6);  // and moving: stands still
  add("revolute", 5);
  add("revolute", 8);
  add("revolute", 9);
  add("fixed", 10);
  return parts;
}

const std::vector<int> kChain{2, 3, 5, 8, 9, 10};

/// Kinematics as the URDF specification has them, and M and G by Jacobians.
struct Reference {
  Eigen::MatrixXd inertia = Eigen::MatrixXd::Zero(6, 6);
  Eigen::VectorXd gravity = Eigen::VectorXd::Zero(6);
  Eigen::Vector3d tip;
};

Reference reference(const std::vector<Part>& parts, const Vector& q) {
  Reference out;
  const std::size_t n = parts.size() + 1;
  std::vector<Eigen::Matrix3d> turned(n, Eigen::Matrix3d::Identity());
  std::vector<Eigen::Vector3d> place(n, Eigen::Vector3d::Zero());
  std::vector<Eigen::MatrixXd> linear(n, Eigen::MatrixXd::Zero(3, 6)), angular = linear;  // at `place`
  for (std::size_t l = 1; l < n; ++l) {
    const Part& part = parts[l - 1];
    const auto found = std::find(kChain.begin(), kChain.end(), static_cast<int>(l));
    const Eigen::Matrix3d r = turned[part.parent] * rotation(part.rpy);
    const Eigen::Vector3d axis = r * part.axis.normalized();
    const Eigen::Vector3d arm = turned[part.parent] * part.xyz;
    place[l] = place[part.parent] + arm;
    turned[l] = r;
    angular[l] = angular[part.parent];
    linear[l] = linear[part.parent];
    for (int k = 0; k < 6; ++k) linear[l].col(k) += Eigen::Vector3d(angular[part.parent].col(k)).cross(arm);
    if (found != kChain.end()) {
      const auto k = static_cast<int>(found - kChain.begin());
      if (std::string(part.type) == "prismatic") {
        place[l] += q[k] * axis;
        for (int c = 0; c < 6; ++c) linear[l].col(c) += q[k] * Eigen::Vector3d(angular[l].col(c)).cross(axis);
        linear[l].col(k) += axis;
      } else {
        turned[l] = r * Eigen::AngleAxisd(q[k], part.axis.normalized()).toRotationMatrix();
        angular[l].col(k) += axis;
      }
    }
    const Eigen::Vector3d centre = turned[l] * part.centre;
    Eigen::MatrixXd at_centre = linear[l];
    for (int k = 0; k < 6; ++k) at_centre.col(k) += Eigen::Vector3d(angular[l].col(k)).cross(centre);
    const Eigen::Matrix3d body = turned[l] * rotation(part.centre_rpy);
    out.inertia += part.mass * at_centre.transpose() * at_centre +
                   angular[l].transpose() * (body * part.inertia * body.transpose()) * angular[l];
    out.gravity += part.mass * 9.81 * at_centre.row(2).transpose();
  }
  out.tip = place.back();
  return out;
}

TEST(UrdfImport, MovesByTheSpecificationInRotatedFrames) {
  const auto parts = random_tree();
  const Robot robot = robot_from_urdf(text_of(parts), "tree.urdf");
  ASSERT_EQ(robot.joints(), 6);
  Random random(61);
  for (int k = 0; k < 20; ++k) {
    const Vector q = draw(random, 6, 3.0);
    const Reference expected = reference(parts, q);
    EXPECT_LT((inertia_matrix(robot.chain, q) - expected.inertia).norm(), 1e-12 * expected.inertia.norm());
    EXPECT_LT((gravity_torque(robot.chain, q) - expected.gravity).norm(), 1e-12 * expected.gravity.norm());
    EXPECT_LT((tip_position(robot.chain, q) - expected.tip).norm(), 1e-12);
  }
}

const char* const kArm = R"(<robot name="arm">
  <!-- masses and friction, drawings left out -->
  <link name="world"/>
  <link name="base_link"><visual><geometry><mesh filename="base.stl"/></geometry></visual></link>
  <joint name="bolt" type="fixed">
    <parent link="world"/><child link="base_link"/><origin xyz="0 0 0.1"/></joint>
  <joint name="shoulder" type="revolute">
    <parent link="base_link"/><child link="upper"/><axis xyz="0 0 2"/>
    <limit lower="-2" upper="2" effort="100" velocity="3"/><dynamics damping="1.5" friction="0.7"/>
  </joint>
  <link name="upper"><inertial><mass value="2"/>
    <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.2"/>
  </inertial></link>
  <joint name="slide" type="prismatic">
    <parent link="upper"/><child link="quill"/><origin xyz="+0.4 0 0" rpy="3.141592653589793 0 0"/>
    <axis xyz="0 0 1"/>
  </joint>
  <link name="quill"/>
</robot>)";

TEST(UrdfImport, ReadsAxesOriginsMassesAndFriction) {
  const Robot robot = robot_from_urdf(kArm, "arm.urdf");
  EXPECT_EQ(robot.name, "arm");
  EXPECT_EQ(robot.axes, "");
  ASSERT_EQ(robot.joints(), 2);
  EXPECT_EQ(robot.chain.geometry[0].axis, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(robot.chain.geometry[0].offset, Eigen::Vector3d(0, 0, 0.1));
  EXPECT_EQ(robot.chain.geometry[1].kind, AxisKind::prismatic);
  EXPECT_EQ(robot.chain.geometry[1].axis, Eigen::Vector3d(0, 0, -1));
  EXPECT_EQ(robot.chain.geometry[1].offset, Eigen::Vector3d(0.4, 0, 0));
  EXPECT_EQ(robot.shapes, (std::vector<LinkShape>{LinkShape::general, LinkShape::general}));
  EXPECT_EQ(robot.chain.links[0].mass, 2.0);
  EXPECT_EQ(robot.chain.links[0].inertia(2, 2), 0.2);
  EXPECT_EQ(robot.chain.links[1].mass, 0.0);
  EXPECT_EQ(robot.chain.friction[0].viscous, 1.5);
  EXPECT_EQ(robot.chain.friction[0].coulomb, 0.7);
  EXPECT_FALSE(robot.identified);
}

TEST(UrdfImport, TheDefaultAxisPointsAlongX) {
  const Robot robot = robot_from_urdf(
      "<robot><link name='a'/><link name='b'/><joint name='j' type='continuous'><parent link='a'/>"
      "<child link='b'/></joint></robot>",
      "x.urdf");
  EXPECT_EQ(robot.chain.geometry[0].axis, Eigen::Vector3d::UnitX());
}

TEST(UrdfImport, WithoutAnyMassLinksStartFromOneKilogram) {
  const Robot robot = robot_from_urdf(
      "<robot><link name='a'/><link name='b'/><joint name='j' type='continuous'><parent link='a'/>"
      "<child link='b'/></joint></robot>",
      "x.urdf");
  EXPECT_EQ(robot.chain.links[0].mass, 1.0);
  EXPECT_EQ(robot.chain.links[0].inertia(1, 1), 0.01);
}

TEST(UrdfImport, RoundTripsThroughARobotFile) {
  const Robot robot = robot_from_urdf(text_of(random_tree()), "tree.urdf");
  const std::string text = robot_file_text(robot);
  EXPECT_EQ(robot_file_text(robot_from_toml(text, "again")), text);
}

TEST(UrdfImport, ARobotFileMayBeAUrdf) {
  const TemporaryFolder folder;
  EXPECT_EQ(load_robot_file(folder.write("arm.urdf", kArm)).joints(), 2);
  EXPECT_EQ(load_robot_file(folder.write("ARM.URDF", kArm)).joints(), 2);
  EXPECT_EQ(load_robot_file(folder.write("arm.xml", kArm)).joints(), 2);
}

}  // namespace
}  // namespace faultline
