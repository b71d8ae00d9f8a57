// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lib/core/error.hpp"
#include "lib/core/random.hpp"
#include "lib/robot/urdf/urdf.hpp"

namespace faultline {
namespace {

std::string link(const std::string& name, const std::string& inside = "") {
  return "<link name='" + name + "'>" + inside + "</link>\n";
}

std::string joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child, const std::string& inside = "") {
  return fmt::format("<joint name='{}' type='{}'><parent link='{}'/><child link='{}'/>{}</joint>\n", name,
                     type, parent, child, inside);
}

std::string robot(const std::string& inside) { return "<robot name='r'>\n" + inside + "</robot>\n"; }

/// The error a text gives, as "where: message"; always of the input.
std::string error_of(const std::string& text) {
  try {
    robot_from_urdf(text, "r.urdf");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input) << error.what();
    return error.what();
  }
  return "no error";
}

void expect_error(const std::string& text, const std::vector<std::string>& parts) {
  const std::string error = error_of(text);
  for (const std::string& part : parts)
    EXPECT_NE(error.find(part), std::string::npos) << part << " in: " << error;
}

const std::string kPair = link("a") + link("b");

TEST(UrdfErrors, BrokenXmlNamesTheLine) {
  expect_error("<robot>\n<link name='a'>\n</robot>", {"r.urdf, line 2", "mismatched element"});
  expect_error("<robot name='r'>\n<link name='a' name='b'/></robot>",
               {"r.urdf, line 2", "parsing attribute"});
  expect_error("", {"not valid XML", "empty document"});
  expect_error("axes = \"RRP\"", {"not valid XML"});
  expect_error("<!-- nothing -->", {"no element"});
  expect_error(std::string("<robot>\0</robot>", 16), {"zero bytes"});
}

TEST(UrdfErrors, AnotherKindOfFileIsNamed) {
  expect_error("<sdf version='1.6'/>", {"line 1, <sdf>", "export the robot as URDF"});
  expect_error("<mujoco/>", {"begins with <robot>"});
  expect_error(robot("<xacro:include filename='x'/>"),
               {"line 2, <xacro:include>", "xacro FILE > robot.urdf"});
  expect_error(robot(kPair + joint("j", "revolute", "a", "b", "<origin xyz='${x} 0 0'/>")), {"xacro first"});
}

TEST(UrdfErrors, MissingAttributesAreNamed) {
  expect_error(robot("<link/>"), {"line 2, <link>", "has no name"});
  expect_error(robot("<link name=''/>"), {"has no name"});
  expect_error(robot(kPair + "<joint name='j'><parent link='a'/><child link='b'/></joint>"),
               {"<joint> \"j\"", "has no type"});
  expect_error(robot(kPair + "<joint name='j' type='fixed'><parent link='a'/></joint>"), {"has no <child>"});
  expect_error(robot(link("a", "<inertial><mass value='1'/></inertial>")),
               {"<inertial>", "has no <inertia>"});
  expect_error(robot(link("a", "<inertial><mass/><inertia ixx='1' iyy='1' izz='1'/></inertial>")),
               {"<mass>", "has no value"});
}

TEST(UrdfErrors, InvalidNumbersAreQuoted) {
  for (const char* bad : {"nan 0 0", "0 inf 0", "0 0", "0 0 0 0", "0,0,0", "1e999 0 0", "0x1 0 0", "one 0 0"})
    expect_error(robot(kPair + joint("j", "revolute", "a", "b", fmt::format("<origin xyz='{}'/>", bad))),
                 {"line 4, <origin>", bad, "3 finite numbers"});
  expect_error(robot(kPair + joint("j", "revolute", "a", "b", "<axis xyz='0 0 0'/>")),
               {"axis without direction"});
  expect_error(robot(kPair + joint("j", "revolute", "a", "b", "<axis xyz='1e300 1e300 0'/>")), {"axis"});
  expect_error(robot(kPair + joint("j", "revolute", "a", "b", "<dynamics damping='-1'/>")),
               {"joint \"j\"", "negative damping"});
}

TEST(UrdfErrors, MassesMustBePhysical) {
  const auto with = [](const char* mass, const char* ixx) {
    return robot(link("a") +
                 link("b", fmt::format("<inertial><origin xyz='1 1 1'/><mass value='{}'/><inertia ixx='{}' "
                                       "iyy='1' izz='1'/></inertial>",
                                       mass, ixx)) +
                 joint("j", "revolute", "a", "b"));
  };
  expect_error(with("-1", "1"), {"link \"b\"", "mass of -1 kg"});
  expect_error(with("1", "-100"), {"link \"b\"", "negative moment of inertia"});
  expect_error(with("1e308", "1"), {"overflow"});
}

TEST(UrdfErrors, JointTypesWithoutAMeaningInAChainAreRefused) {
  expect_error(robot(kPair + joint("j", "screw", "a", "b")), {"\"screw\"", "expected revolute"});
  expect_error(robot(kPair + joint("j", "floating", "a", "b")),
               {"joint \"j\"", "is floating", "Make it fixed"});
  expect_error(robot(kPair + joint("j", "planar", "a", "b")), {"joint \"j\"", "is planar"});
  expect_error(robot(kPair + joint("j", "revolute", "a", "b", "<mimic joint='k'/>")),
               {"joint \"j\"", "mimics another joint"});
  expect_error(robot(kPair + joint("j", "fixed", "a", "b")), {"no moving joint"});
}

TEST(UrdfErrors, LinksThatDoNotFormATreeAreNamed) {
  expect_error(robot(""), {"no <link>"});
  expect_error(robot(kPair), {"several bases: \"a\", \"b\""});
  expect_error(robot(kPair + joint("j", "revolute", "a", "c")), {"\"j\"", "child the link \"c\""});
  expect_error(robot(kPair + joint("j", "revolute", "a", "b") + joint("k", "revolute", "b", "a")),
               {"no base", "form a loop"});
  expect_error(robot(kPair + joint("j", "revolute", "a", "a")), {"form a loop", "\"a\""});
  expect_error(
      robot(link("base") + kPair + joint("j", "revolute", "a", "b") + joint("k", "revolute", "b", "a")),
      {"form a loop", "\"a\", \"b\""});
  expect_error(robot(kPair + link("c") + joint("j", "revolute", "a", "c") + joint("k", "revolute", "b", "c")),
               {"joint \"k\"", "child of joint \"j\""});
}

TEST(UrdfErrors, RepeatedNamesAreRefused) {
  expect_error(robot(link("a") + link("a")), {"line 3, <link> \"a\"", "names must be unique"});
  expect_error(robot(kPair + link("c") + joint("j", "fixed", "a", "b") + joint("j", "fixed", "b", "c")),
               {"<joint> \"j\"", "names must be unique"});
  expect_error(robot(link("a", "<inertial/><inertial/>")), {"more than one <inertial>"});
}

TEST(UrdfErrors, TwoEquallyLongChainsAreRefusedWithTheirTips) {
  expect_error(robot(kPair + link("left") + link("right") + joint("j", "revolute", "a", "b") +
                     joint("l", "prismatic", "b", "left") + joint("r", "prismatic", "b", "right")),
               {"2 chains of 2 moving joints", "\"left\", \"right\"", "make the joints fixed"});
}

TEST(UrdfErrors, TooManyJointsAreRefusedWithTheirNumber) {
  std::string text = link("l0");
  for (int i = 1; i <= 9; ++i)
    text += link(fmt::format("l{}", i)) +
            joint(fmt::format("j{}", i), "revolute", fmt::format("l{}", i - 1), fmt::format("l{}", i));
  expect_error(robot(text), {"9 moving joints", "at most 8"});
}

TEST(UrdfErrors, AHugeOrDeepFileIsRefused) {
  expect_error(robot(link("a")) + std::string(33u << 20, ' '), {"at most 32 MB"});
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  expect_error(robot(deep), {"not valid XML"});
}

TEST(UrdfErrors, AVeryLongChainOfFixedLinksIsRead) {
  std::string text = link("l0");
  for (int i = 1; i <= 20000; ++i)
    text += link(fmt::format("l{}", i)) + joint(fmt::format("j{}", i), i == 7 ? "revolute" : "fixed",
                                                fmt::format("l{}", i - 1), fmt::format("l{}", i));
  EXPECT_EQ(robot_from_urdf(robot(text), "r.urdf").joints(), 1);
}

TEST(UrdfErrors, DamagedBytesGiveARobotOrOneError) {
  const std::string whole = urdf_text(preset_robot("RRP"));
  Random random(9);
  for (int k = 0; k < 3000; ++k) {
    std::string text = whole;
    for (int edits = 0; edits < 3; ++edits) {
      const auto at = static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(text.size() - 1)));
      if (random.uniform(0.0, 1.0) < 0.5)
        text[at] = static_cast<char>(random.uniform(0.0, 256.0));
      else
        text.erase(at, static_cast<std::size_t>(random.uniform(0.0, 40.0)));
    }
    try {
      robot_from_urdf(text, "r.urdf");
    } catch (const Error& error) {
      EXPECT_NE(error.code(), ErrorCode::internal);
    }
  }
}

}  // namespace
}  // namespace faultline
