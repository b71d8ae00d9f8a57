// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/reproduce/generator/generator_measurements.hpp"

namespace faultline {

// What stands above the tables of the residual generators, as Markdown.

std::string generator_mse_text(const GeneratorMeasurements& measured, const GeneratorScale& scale);
std::string generator_by_output_text();
std::string generator_friction_text(const GeneratorMeasurements& measured, const GeneratorScale& scale);

}  // namespace faultline
