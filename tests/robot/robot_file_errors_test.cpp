// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lib/core/error.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

/// The error a text gives, as "where: message".
std::string error_of(const std::string& text) {
  try {
    robot_from_toml(text, "r.toml");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    return error.what();
  }
  return "no error";
}

void expect_error(const std::string& text, const std::vector<std::string>& parts) {
  const std::string error = error_of(text);
  for (const std::string& part : parts)
    EXPECT_NE(error.find(part), std::string::npos) << part << " in: " << error;
}

TEST(RobotFileErrors, MissingAxesAreNamed) {
  expect_error("name = \"x\"", {"r.toml", "axes = \"RRP\"", "[[joint]]"});
}

TEST(RobotFileErrors, UnknownAxesListThePresets) {
  expect_error("\naxes = \"RXP\"", {"r.toml, line 2, key axes", "\"RXP\"", "RRPR", "[[joint]]"});
}

TEST(RobotFileErrors, UnknownKeySuggestsTheNearest) {
  expect_error("axes = \"RRP\"\n\ngravty = [0,0,1]",
               {"r.toml, line 3, key gravty", "did you mean \"gravity\""});
  expect_error("axes = \"RRP\"\n[log]\ntorqe = \"held\"",
               {"line 3, key log.torqe", "did you mean \"torque\""});
}

TEST(RobotFileErrors, WrongTypesNameTheExpectedType) {
  expect_error("axes = 3", {"line 1, key axes", "expected a text in quotes, found 3"});
  expect_error("axes = \"RRP\"\ngravity = [0, 0]", {"key gravity", "3 numbers", "found 2"});
  expect_error("axes = \"RRP\"\ngravity = 9.81", {"key gravity", "found 9.81"});
  expect_error("axes = \"RRP\"\n[known]\nl1 = \"long\"", {"line 3, key known.l1", "finite number", "long"});
  expect_error("axes = \"RRP\"\n[known]\nl1 = nan", {"known.l1", "finite number"});
}

TEST(RobotFileErrors, WrongValuesNameTheExpectedValue) {
  expect_error("axes = \"RRP\"\n[known]\nm9 = 1", {"known.m9", "joint from 1 to 3"});
  expect_error("axes = \"RRP\"\n[known]\nm1 = -1", {"known.m1", "not negative"});
  expect_error("axes = \"RRP\"\n[log]\ntorque = \"comanded\"", {"log.torque", "did you mean \"commanded\""});
  expect_error("axes = \"RRP\"\n[log.columns]\nq4 = \"x\"", {"log.columns.q4", "q1..q3"});
  expect_error("axes = \"RRP\"\n[log.columns]\nq1 = {sign = 2}", {"log.columns.q1.sign", "1 or -1"});
  expect_error("axes = \"RRP\"\n[log.columns]\nq1 = {field = \"q[0]\"}", {"log.columns.q1.field", "topic"});
  expect_error("axes = \"RRP\"\n[log.columns]\nq1 = {name = \"a\", topic = \"/a\", field = \"q[0]\"}",
               {"log.columns.q1.name", "either"});
  expect_error("axes = \"RRP\"\n[[link]]\nmass = 1", {"key link", "each of the 3 joints", "found 1"});
  expect_error("axes = \"RRP\"\nwidth = 0", {"key width", "positive"});
}

TEST(RobotFileErrors, InvalidNormalRangesAreNamed) {
  const std::string normal = "axes = \"RRP\"\n[normal]\n";
  expect_error(normal + "friction = 1.5", {"line 3, key normal.friction", "less than 1", "found 1.5"});
  expect_error(normal + "torque_constant = -0.1",
               {"key normal.torque_constant", "share from 0", "found -0.1"});
  expect_error(normal + "model_error = \"light\"", {"key normal.model_error", "finite number", "light"});
  expect_error(normal + "noise = [2, 0.5]", {"key normal.noise", "at most 1", "found [2, 0.5]"});
  expect_error(normal + "noise = 2", {"key normal.noise"});
  expect_error(normal + "work_piece_kg = -2", {"key normal.work_piece_kg", "positive", "found -2"});
  expect_error(normal + "fricton = 0.2", {"key normal.fricton", "did you mean \"friction\""});
}

TEST(RobotFileErrors, CouplingMustBeARegularMatrixOfAllJoints) {
  const std::string log = "axes = \"RR\"\n[log]\n";
  expect_error(log + "coupling = [[1, 0]]", {"line 3, key log.coupling", "2 rows of 2 numbers", "1 row"});
  expect_error(log + "coupling = [[1, 0], [1, 0, 0]]", {"key log.coupling", "2 numbers"});
  expect_error(log + "coupling = [[1, 2], [2, 4]]", {"key log.coupling", "singular"});
  expect_error(log + "coupling = [[0, 0], [0, 0]]", {"key log.coupling", "singular"});
  expect_error(log + "coupling = [[1, nan], [0, 1]]", {"key log.coupling", "finite"});
  expect_error(log + "coupling = 2", {"key log.coupling"});
}

TEST(RobotFileErrors, BrokenTomlNamesThePlace) {
  expect_error("axes = \"RRP\"\n[known\n", {"r.toml, line 2", "not valid TOML"});
}

TEST(RobotFileErrors, MissingFileIsAnInputError) {
  try {
    load_robot_file("/nonexistent/robot.toml");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
  }
}

}  // namespace
}  // namespace faultline
