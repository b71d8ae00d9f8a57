// SPDX-License-Identifier: MIT
#include "lib/model/model_files.hpp"

#include "lib/cases/case_file.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/hash.hpp"
#include "lib/model/model_text.hpp"

namespace faultline {
namespace {

constexpr std::size_t kIdentityLength = 32;

std::string name_of(const std::string& identity) { return identity.substr(0, kIdentityLength); }

}  // namespace

void bind_cases(Model& model, CaseBase& cases) {
  model.identity.clear();
  model.identity = sha256_hex(model_to_json(model)).substr(0, kIdentityLength);
  cases.belong_to(model.identity);
  cases.describe_robot(case_robot_of(model));
}

CaseRobot case_robot_of(const Model& model) {
  CaseRobot robot{model.robot.name, ""};
  for (const JointGeometry& joint : model.robot.chain.geometry)
    robot.axes += joint.kind == AxisKind::revolute ? 'R' : 'P';
  return robot;
}

ModelFiles load_model_files(const std::string& model, const std::string& cases) {
  ModelFiles files{load_model(model), read_case_base(cases)};
  if (files.model.identity != files.cases.model_identity())
    throw Error(ErrorCode::input, cases,
                "belongs to another model than " + model + " (identity " +
                    name_of(files.cases.model_identity()) + ", the model has " +
                    name_of(files.model.identity) +
                    "): learn was interrupted, or one of the two files was copied alone. Restore both from "
                    "one copy, or learn again, which keeps confirmed cases; `faultline cases import FILE "
                    "--model MODEL` binds exported cases to a model");
  return files;
}

bool sign_model(const std::string& path, const std::string& why) {
  const std::string text = read_file(path);
  const std::string accepted = signed_model_text(text, why, path);
  model_from_json(accepted, path);
  if (accepted == text) return false;
  write_file(path, accepted);
  return true;
}

std::vector<std::string> notes_of(const Model& model) {
  std::vector<std::string> notes;
  for (const std::string& doubt : model.doubts) notes.push_back("the model is doubtful: " + doubt);
  for (const ModelEdit& edit : model.edits)
    notes.push_back("the model was edited by hand after it was learned" +
                    (edit.why.empty() ? std::string(", the reason is not recorded") : ": " + edit.why));
  return notes;
}

}  // namespace faultline
