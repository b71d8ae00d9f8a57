// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "apps/work/golden_work.hpp"
#include "lib/core/error.hpp"
#include "lib/golden/default_tolerances.hpp"
#include "lib/golden/golden_folder.hpp"

namespace faultline {
namespace {

/// Returns the item with the given name, or with that name without extension if it is unique.
std::string item_named(const std::string& given, const GoldenCheck& check) {
  std::vector<std::string> stems, names;
  for (const CheckedItem& item : check.items) {
    if (item.name == given) return item.name;
    if (std::filesystem::path(item.name).stem() == given) stems.push_back(item.name);
    names.push_back(item.name);
  }
  if (stems.size() == 1) return stems.front();
  throw Error(ErrorCode::usage, given,
              fmt::format("{}; expected one of {}",
                          stems.empty() ? "is not a log of this golden folder" : "matches more than one log",
                          fmt::join(names, ", ")));
}

GoldenCheck only(const GoldenCheck& check, const std::vector<std::string>& names) {
  GoldenCheck part = check;
  std::erase_if(part.items, [&](const CheckedItem& item) {
    return std::find(names.begin(), names.end(), item.name) == names.end();
  });
  return part;
}

std::vector<std::string> named_items(const AcceptArguments& arguments, const GoldenCheck& check) {
  std::vector<std::string> names;
  for (const std::string& given : arguments.names) names.push_back(item_named(given, check));
  if (arguments.names.empty())
    for (const CheckedItem& item : check.items)
      if (!arguments.same_verdict || !item.changes_verdict()) names.push_back(item.name);
  return names;
}

/// Returns the named items that change; all with a new model, or if reasons were not recorded yet.
std::vector<std::string> changing(const GoldenCheck& part, bool all) {
  std::vector<std::string> names;
  for (const CheckedItem& item : part.items)
    if (all || !item.same()) names.push_back(item.name);
  return names;
}

/// Returns, for --same-verdict, the items whose expected results stay because their verdict differs.
std::vector<std::string> found_otherwise(const AcceptArguments& arguments, const GoldenCheck& check) {
  std::vector<std::string> names;
  for (const CheckedItem& item : check.items)
    if (arguments.same_verdict && item.changes_verdict()) names.push_back(item.name);
  return names;
}

}  // namespace

AcceptPlan plan_accept(const AcceptArguments& arguments, const Progress& progress) {
  AcceptPlan plan;
  plan.set = load_golden(arguments.folder);
  plan.subject = golden_subject(arguments, plan.set);
  plan.run = golden_run(arguments, plan.set, plan.subject, progress);
  plan.check = check_golden(plan.set, plan.run);
  plan.part = only(plan.check, named_items(arguments, plan.check));
  plan.otherwise = found_otherwise(arguments, plan.check);
  plan.names = changing(plan.part, arguments.has_new_model());
  return plan;
}

void carry_out(const AcceptPlan& plan, const AcceptArguments& arguments) {
  const std::string& folder = arguments.folder;
  if (plan.names.empty()) {
    remove_orphaned_files(folder, plan.set);
    return;
  }
  const NewModel model = arguments.has_new_model()
                             ? NewModel{arguments.model, arguments.case_base(), &plan.subject}
                             : NewModel{};
  accept_golden(folder, plan.set, plan.run, plan.names, model, default_tolerances(plan.subject.model));
  remove_orphaned_files(folder, load_golden(folder));
}

}  // namespace faultline
