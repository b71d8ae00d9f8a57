// SPDX-License-Identifier: MIT
// Export and import of cases.
#include <fmt/format.h>

#include <algorithm>

#include "apps/cases/case_actions.hpp"
#include "apps/work/file_use.hpp"
#include "lib/cases/carry_over.hpp"
#include "lib/cases/case.hpp"
#include "lib/cases/case_file.hpp"
#include "lib/cases/possible_labels.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"
#include "lib/model/model_files.hpp"

namespace faultline {
namespace {

/// Returns the base with only those cases of the robot at work that a person identified.
CaseBase confirmed_of(const CaseBase& base) {
  std::vector<Case> cases = base.cases();
  std::erase_if(cases, [](const Case& c) { return origin_of(c) != CaseOrigin::field; });
  for (Case& c : cases)
    if (c.robot.empty()) c.robot = base.robot().name;
  CaseBase confirmed(base.metric(), std::move(cases));
  confirmed.belong_to(base.model_identity());
  confirmed.describe_robot(base.robot());
  return confirmed;
}

/// Merges the cases; writes nothing if none is new.
MergedCases merge_into(const CasesArguments& arguments, const CaseBase& other) {
  MergedCases merged = read_case_base(arguments.path()).merge(other);
  if (merged.added + merged.updated > 0)
    change_case_base(arguments.path(), [&](CaseBase& base) { merged = base.merge(other); });
  return merged;
}

/// Binds the cases to the model. Throws Error(usage) when they are of a robot of another kind than the
/// model's.
void bind_to_model(CaseBase& imported, const std::string& path) {
  const Model model = load_model(path);
  const CaseRobot robot = case_robot_of(model);
  const std::string& axes = imported.robot().axes;
  if (axes != robot.axes)
    throw Error(ErrorCode::usage, path,
                "is the model of a robot with the axes " + robot.axes +
                    ", but the cases are of a robot with the axes " + axes);
  const std::string seen_on = imported.robot().name;
  if (seen_on != robot.name)
    for (Case c : std::vector<Case>(imported.cases())) {
      if (!c.robot.empty()) continue;
      c.robot = seen_on;
      imported.replace(std::move(c));
    }
  imported.describe_robot(robot);
  imported.belong_to(model.identity);
}

}  // namespace

CasesAnswer export_cases(const CasesArguments& arguments) {
  FileUse().reads(ModelPaths{arguments.model, arguments.path()}).writes("-o", arguments.file).claim();
  const CaseBase base = read_case_base(arguments.path());
  const CaseBase exported = arguments.confirmed ? confirmed_of(base) : base;
  write_file(arguments.file, to_cases_json(exported));
  CasesAnswer answer;
  if (arguments.confirmed)
    answer.note = fmt::format("{} of {} cases were confirmed or corrected in the field",
                              exported.cases().size(), base.cases().size());
  return answer;
}

/// Returns a sentence about the cases that --replace will drop.
std::string replaced_text(const std::string& path) {
  try {
    const CaseBase old = read_case_base(path);
    const auto of_people = std::count_if(old.cases().begin(), old.cases().end(),
                                         [](const Case& c) { return !is_made_by_learn(c); });
    return fmt::format("; {} that {} there before {} replaced, {} of them described by people",
                       counted(std::ssize(old.cases()), "case"), old.cases().size() == 1 ? "was" : "were",
                       old.cases().size() == 1 ? "was" : "were", of_people);
  } catch (const Error&) {
    return "; the earlier case base could not be read and was replaced";
  }
}

CasesAnswer import_cases(const CasesArguments& arguments) {
  FileUse()
      .reads("the export", arguments.file)
      .reads("the model", arguments.model)
      .writes_case_base("the case base", arguments.path())
      .claim();
  CaseBase imported = from_cases_json(read_file(arguments.file), arguments.file);
  for (const Case& c : imported.cases())
    check_joint(joints_of(imported), c.label, fmt::format("{}, case {}", arguments.file, c.id));
  if (!arguments.model.empty() && !arguments.merge) bind_to_model(imported, arguments.model);
  const std::string path = arguments.path();
  MergedCases merged{std::ssize(imported.cases()), 0};
  const std::string replaced = has_case_base(path) && !arguments.merge ? replaced_text(path) : "";
  if (arguments.merge)
    merged = merge_into(arguments, imported);
  else if (has_case_base(path) && !arguments.replace)
    throw Error(ErrorCode::usage, path, "already exists; choose --merge to add to it, or --replace");
  else
    write_case_base(path, imported);
  const std::size_t read = imported.cases().size();
  const std::string updated = merged.updated > 0 ? fmt::format(", {} updated", merged.updated) : "";
  return {{{"read", read}, {"added", merged.added}, {"updated", merged.updated}},
          fmt::format("{} read, {} added{}{}\n", counted(std::ssize(imported.cases()), "case"), merged.added,
                      updated, replaced)};
}

}  // namespace faultline
