// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "lib/robot/toml/toml_table.hpp"
#include "lib/simulate/simulate.hpp"

/// The sections of a spec file, read over what `SimulationSpec` holds already. Throw Error(usage) naming the
/// key that cannot be read; whether the numbers fit each other and the robot is for check_simulation().
namespace faultline {

/// [motion] and [controller]; the seed is that of `mass_error_std`.
void read_motion(const TomlTable& table, int joints, MotionSpec& motion);
void read_controller(const TomlTable& table, int joints, std::uint64_t seed, ControllerSpec& controller);

/// [noise], [drives], [limits], [gears], [stick_slip], [warm_up], [work_piece] and [recording] of `file`.
void read_machine(const TomlTable& file, int joints, SimulationSpec& spec);

/// A whole number of modest size, for joints and counts.
int small_integer(const TomlTable& table, const std::string& key, int fallback);

}  // namespace faultline
