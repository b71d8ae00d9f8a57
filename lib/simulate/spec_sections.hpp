// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "lib/robot/toml/toml_table.hpp"
#include "lib/simulate/simulate.hpp"

/// Readers of the sections of a spec file; absent keys keep the values of the spec given. They throw
/// Error(usage) naming an invalid key; check_simulation() checks the values against each other and the robot.
namespace faultline {

/// Reads [motion] and [controller]; `seed` draws the errors for `mass_error_std`.
MotionSpec read_motion(const TomlTable& table, int joints, MotionSpec motion);
ControllerSpec read_controller(const TomlTable& table, int joints, std::uint64_t seed,
                               ControllerSpec controller);

/// Reads [noise], [drives], [limits], [gears], [stick_slip], [warm_up], [work_piece], [recording] of `file`.
SimulationSpec read_machine(const TomlTable& file, int joints, SimulationSpec spec);

/// Returns a whole number from 0 to 1000, for joints and counts.
int small_integer(const TomlTable& table, const std::string& key, int fallback);

}  // namespace faultline
