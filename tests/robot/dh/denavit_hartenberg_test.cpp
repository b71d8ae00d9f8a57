// SPDX-License-Identifier: MIT
#include "lib/robot/dh/denavit_hartenberg.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lib/core/error.hpp"
#include "lib/robot/dynamics.hpp"
#include "lib/robot/robot_file.hpp"
#include "tests/robot/assorted_chains.hpp"
#include "tests/support/chain_mechanics.hpp"

/// Published tables against the products of their transforms, written out as in the textbooks.
namespace faultline {
namespace {

using Vector = JointVector;

constexpr double kQuarter = std::numbers::pi / 2.0;

struct Arm {
  const char* name;
  DhConvention convention;
  std::vector<AxisKind> kinds;
  std::vector<DhRow> rows;  // a, alpha, d, theta
};

constexpr auto kTurn = AxisKind::revolute;

/// Universal Robots UR10, Staubli TX40, the Stanford arm and, in Craig's convention, PUMA 560 and Panda.
std::vector<Arm> published() {
  const double h = kQuarter;
  const std::vector<AxisKind> six(6, kTurn), seven(7, kTurn);
  return {
      {"UR10",
       DhConvention::standard,
       six,
       {{0, h, 0.1273, 0},
        {-0.612, 0, 0, 0},
        {-0.5723, 0, 0, 0},
        {0, h, 0.163941, 0},
        {0, -h, 0.1157, 0},
        {0, 0, 0.0922, 0}}},
      {"TX40",
       DhConvention::modified,
       six,
       {{0, 0, 0, 0}, {0, -h, 0, -h}, {0.225, 0, 0.035, h}, {0, h, 0.225, 0}, {0, -h, 0, 0}, {0, h, 0, 0}}},
      {"Stanford",
       DhConvention::standard,
       {kTurn, kTurn, AxisKind::prismatic, kTurn, kTurn, kTurn},
       {{0, -h, 0.412, 0}, {0, h, 0.154, 0}, {0, 0, 0.3, -h}, {0, -h, 0, 0}, {0, h, 0, 0}, {0, 0, 0.263, 0}}},
      {"PUMA 560",
       DhConvention::modified,
       six,
       {{0, 0, 0, 0},
        {0, -h, 0, 0},
        {0.4318, 0, 0.1491, 0},
        {0.0203, -h, 0.4331, 0},
        {0, h, 0, 0},
        {0, -h, 0, 0}}},
      {"Panda",
       DhConvention::modified,
       seven,
       {{0, 0, 0.333, 0},
        {0, -h, 0, 0},
        {0, h, 0.316, 0},
        {0.0825, h, 0, 0},
        {-0.0825, -h, 0.384, 0},
        {0, h, 0, 0},
        {0.088, h, 0, 0}}}};
}

/// The textbook matrix of a row with the joint at q.
Eigen::Matrix4d closed_form(const DhRow& row, AxisKind kind, double q, DhConvention convention) {
  const double theta = row.theta + (kind == kTurn ? q : 0.0), d = row.d + (kind == kTurn ? 0.0 : q);
  const double ct = std::cos(theta), st = std::sin(theta), ca = std::cos(row.alpha), sa = std::sin(row.alpha);
  Eigen::Matrix4d t;
  if (convention == DhConvention::standard)
    t << ct, -st * ca, st * sa, row.a * ct, st, ct * ca, -ct * sa, row.a * st, 0, sa, ca, d, 0, 0, 0, 1;
  else
    t << ct, -st, 0, row.a, st * ca, ct * ca, -sa, -sa * d, st * sa, ct * sa, ca, ca * d, 0, 0, 0, 1;
  return t;
}

std::string file_of(const Arm& arm) {
  std::string text;
  for (std::size_t i = 0; i < arm.rows.size(); ++i) {
    const DhRow& r = arm.rows[i];
    text += fmt::format("[[joint]]\nkind = \"{}\"\n{} = {{a = {}, alpha = {}, d = {}, theta = {}}}\n",
                        arm.kinds[i] == kTurn ? "revolute" : "prismatic",
                        arm.convention == DhConvention::standard ? "dh" : "mdh", r.a, r.alpha, r.d, r.theta);
  }
  return text;
}

/// Frame i of the table (0 the base) at q.
std::vector<Eigen::Matrix4d> table_frames(const Arm& arm, const Vector& q) {
  std::vector<Eigen::Matrix4d> frames{Eigen::Matrix4d::Identity()};
  for (std::size_t i = 0; i < arm.rows.size(); ++i)
    frames.push_back(frames.back() *
                     closed_form(arm.rows[i], arm.kinds[i], q[static_cast<int>(i)], arm.convention));
  return frames;
}

class PublishedTable : public testing::TestWithParam<Arm> {};

TEST_P(PublishedTable, GivesThePoseOfEveryLinkOfItsClosedForm) {
  const Arm& arm = GetParam();
  const Robot robot = robot_from_toml(file_of(arm), arm.name);
  const int n = robot.joints();
  const auto rest = table_frames(arm, Vector::Zero(n));
  Random random(50);
  for (int k = 0; k < 50; ++k) {
    const Vector q = draw(random, n, 3.0);
    const auto frames = table_frames(arm, q);
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    for (int i = 0; i < n; ++i) {
      const auto pose = link_pose(robot.chain, i, q[i]);
      position += rotation * pose.position;
      rotation = (rotation * pose.rotation).eval();
      // The table's frame i+1 as link i carries it from where it is at rest.
      const Eigen::Matrix3d turned = rotation * rest[i + 1].topLeftCorner<3, 3>();
      EXPECT_LT((turned - frames[i + 1].topLeftCorner<3, 3>()).norm(), 1e-12)
          << arm.name << " link " << i + 1;
      Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // of link i at rest
      for (int j = 0; j <= i; ++j) origin += robot.chain.geometry[j].offset;
      const Eigen::Vector3d carried = position + rotation * (rest[i + 1].topRightCorner<3, 1>() - origin);
      EXPECT_LT((carried - frames[i + 1].topRightCorner<3, 1>()).norm(), 1e-12)
          << arm.name << " link " << i + 1;
    }
    EXPECT_LT((tip_position(robot.chain, q) - frames.back().topRightCorner<3, 1>()).norm(), 1e-12)
        << arm.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Arms, PublishedTable, testing::ValuesIn(published()), [](const auto& arm) {
  std::string name = arm.param.name;
  std::erase(name, ' ');
  return name;
});

TEST(DenavitHartenberg, RightAnglesGiveExactAxesAndOffsets) {
  const Robot robot = robot_from_toml(file_of(published()[0]), "UR10");
  EXPECT_EQ(robot.chain.geometry[1].axis, Eigen::Vector3d(0, -1, 0));
  EXPECT_EQ(robot.chain.geometry[1].offset, Eigen::Vector3d(0, 0, 0.1273));
  EXPECT_EQ(robot.shapes[3], LinkShape::general);
}

TEST(DenavitHartenberg, RoundTripsAsAxesAndOffsets) {
  const Robot robot = robot_from_toml(file_of(published()[4]), "Panda");
  const std::string text = robot_file_text(robot);
  EXPECT_EQ(robot_file_text(robot_from_toml(text, "again")), text);
}

void expect_error(const std::string& text, const std::string& where, const std::string& what) {
  try {
    robot_from_toml(text, "r.toml");
    FAIL() << text;
  } catch (const Error& error) {
    EXPECT_NE(error.where().find(where), std::string::npos) << error.what();
    EXPECT_NE(error.message().find(what), std::string::npos) << error.what();
  }
}

TEST(DenavitHartenberg, OtherKeysThatPlaceJointsAreRefused) {
  const std::string row = "[[joint]]\nkind = \"revolute\"\ndh = {a = 1}\n";
  expect_error("axes = \"R\"\n" + row, "line 1, key axes", "leave out axes");
  expect_error(row + "axis = [0, 0, 1]\n", "joint[1].axis", "together with dh");
  expect_error(row + row + "mdh = {a = 1}\n", "joint[2].mdh", "one convention");
  expect_error(row + "[[joint]]\nkind = \"prismatic\"\n", "joint[2]", "every joint");
  expect_error(row + "[known]\nl1 = 1\n", "r.toml", "length together with dh");
  expect_error(row + "[[link]]\nlength = 1\n", "r.toml", "length together with dh");
  expect_error(row + "[[link]]\nshape = \"rod\"\n", "link", "rod");
  expect_error("[[joint]]\nkind = \"revolute\"\ndh = {a = 1, alfa = 2}\n", "joint[1].dh.alfa", "\"alpha\"");
}

}  // namespace
}  // namespace faultline
