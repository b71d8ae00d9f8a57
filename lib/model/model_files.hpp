// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/cases/case_base.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// The robot of a model, as its case base tells it.
CaseRobot case_robot_of(const Model& model);

/// Gives a model and the case base that was learned with it the same identity, which follows from the model,
/// and the case base its robot.
void bind_cases(Model& model, CaseBase& cases);

/// A model with its case base.
struct ModelFiles {
  Model model;
  CaseBase cases;
};

/// Reads both. Throws Error(input) also when the case base belongs to another model.
ModelFiles load_model_files(const std::string& model, const std::string& cases);

/// What a reader of a diagnosis must know of the model besides its name, a sentence each: that it was edited
/// by hand, that it carries no digest.
std::vector<std::string> notes_of(const Model& model);

}  // namespace faultline
