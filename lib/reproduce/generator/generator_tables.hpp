// SPDX-License-Identifier: MIT
#pragma once

#include "lib/reproduce/generator/generator_measurements.hpp"
#include "lib/reproduce/page/result_table.hpp"

namespace faultline {

/// Every candidate of the robot without friction by controller and test set, the other study's figures
/// beside.
ResultTable generator_mse_table(const GeneratorMeasurements& measured, const GeneratorScale& scale);
/// The paper's network by output, by either trainer.
ResultTable generator_by_output_table(const GeneratorMeasurements& measured);
/// Every candidate of the robot with friction.
ResultTable generator_friction_table(const GeneratorMeasurements& measured, const GeneratorScale& scale);

}  // namespace faultline
