// SPDX-License-Identifier: MIT
#include "lib/robot/robot_file.hpp"
#include "lib/simulate/spec_file.hpp"
#include "tests/fuzz/readers/feeding.hpp"
#include "tests/fuzz/readers/readers.hpp"

namespace faultline {

void feed_robot(const std::string& bytes) {
  read_or_refuse([&] {
    const std::string text = robot_file_text(robot_from_toml(bytes, "robot.toml"));
    Robot again;
    try {
      again = robot_from_toml(text, "again.toml");
    } catch (const Error& error) {
      throw std::logic_error(std::string("a written robot file loads again: ") + error.what());
    }
    demand(robot_file_text(again) == text, "a robot that is written and loaded is the same");
  });
}

void feed_spec(const std::string& bytes) {
  read_or_refuse([&] { simulation_from_toml(bytes, "spec.toml", "/nonexistent"); });
}

}  // namespace faultline
