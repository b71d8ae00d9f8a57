// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/model/model.hpp"
#include "lib/report/fact_table.hpp"

/// What a model knows of itself, for people.
namespace faultline {

/// Robot, usual sample period, and how much of each joint's torque the identified robot explains.
FactTable robot_facts(const Model& model);

FactTable parameter_table(const Identification& identification);
/// Physical parameters, then base parameters; one that is both is there once. They belong to
/// `identification`.
std::vector<const ParameterEstimate*> listed_parameters(const Identification& identification);

FactTable validation_table(const Validation& validation);
/// What was counted in a row: runs, found, right joint, right, right or named.
std::vector<std::string> validation_counts(const ValidationRow& row);

FactTable source_table(const Model& model);

}  // namespace faultline
