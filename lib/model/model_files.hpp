// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/cases/case_base.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// Returns the robot of a model as its case base stores it.
CaseRobot case_robot_of(const Model& model);

/// Gives a model and the case base that was learned with it the same identity, a hash of the model, and gives
/// the case base the robot.
void bind_cases(Model& model, CaseBase& cases);

struct ModelFiles {
  Model model;
  CaseBase cases;
};

/// Reads both files. Throws Error(input) also if the case base belongs to another model.
ModelFiles load_model_files(const std::string& model, const std::string& cases);

/// Accepts a model that was edited by hand: writes a digest that fits, with a note that it was edited and
/// `why`. Returns false, and changes nothing, if the digest fits already. Throws Error(input) if it is no
/// model.
bool sign_model(const std::string& path, const std::string& why);

/// Returns notes on the model for the reader of a diagnosis, a sentence each: its doubts, and that it was
/// edited by hand.
std::vector<std::string> notes_of(const Model& model);

}  // namespace faultline
