// SPDX-License-Identifier: MIT
#include "apps/cases/case_actions.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "apps/cases/case_text.hpp"
#include "apps/exit_status.hpp"
#include "apps/file_use.hpp"
#include "apps/terminal.hpp"
#include "lib/cases/case_file.hpp"
#include "lib/cases/case_json.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/model/model.hpp"
#include "lib/report/case_from_json.hpp"

namespace faultline {
namespace {

void print_case(const CaseBase& base, const Case& c, const CasesArguments& arguments,
                const std::string& text) {
  print(arguments.json ? to_json(base, c).dump(2) + "\n" : text);
}

bool is_asked_for(const Case& c, const CasesArguments& arguments) {
  if (!arguments.outcome.empty() && c.outcome != case_outcome_from(arguments.outcome)) return false;
  if (!arguments.fault.empty() && c.label.kind != fault_kind_from(arguments.fault)) return false;
  return arguments.joint == 0 || c.label.joint == arguments.joint;
}

/// Changes the base in one transaction and prints the case whose id `change` returns.
int change_and_print(const CasesArguments& arguments, const std::function<std::int64_t(CaseBase&)>& change) {
  CaseBase changed;
  std::int64_t id = 0;
  change_case_base(arguments.path(), [&](CaseBase& base) {
    id = change(base);
    changed = base;
  });
  print_case(changed, changed.at(id), arguments, case_line(changed.at(id)));
  return kNothingFound;
}

Case new_case(const CasesArguments& arguments, const CaseBase& base) {
  Case c;
  if (!arguments.diagnosis.empty())
    c = case_from_json(read_file(arguments.diagnosis), arguments.diagnosis, arguments.fault_id,
                       base.feature_names());
  else if (const auto label = arguments.label()) {
    c.decision = *label;
    c.episode.features.assign(base.metric().features.size(), std::numeric_limits<double>::quiet_NaN());
    c.origin = "recorded by hand";
    tell("the case has no measured features, so no diagnosis will find it similar");
  } else
    throw Error(ErrorCode::usage, "faultline cases add", "needs a diagnosis (JSON report) or --fault KIND");
  c.what_was_done = arguments.done;
  return c;
}

}  // namespace

std::string CasesArguments::path() const {
  if (cases.empty() == model.empty())
    throw Error(ErrorCode::usage, "faultline cases", "needs either --cases FILE or --model MODEL");
  return case_base();
}

std::optional<FaultLabel> CasesArguments::label() const {
  if (fault.empty() && joint == 0) return {};
  if (fault.empty()) throw Error(ErrorCode::usage, "--joint", "needs --fault KIND beside it");
  return FaultLabel{fault_kind_from(fault), joint};
}

int list_cases(const CasesArguments& arguments) {
  const CaseBase base = read_case_base(arguments.path());
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  std::string text;
  int shown = 0;
  for (const Case& c : base.cases()) {
    if (!is_asked_for(c, arguments)) continue;
    ++shown;
    if (arguments.json)
      json.push_back(to_json(base, c));
    else
      text += case_line(c);
  }
  print(arguments.json ? json.dump(2) + "\n"
                       : text + fmt::format("{} of {} cases\n", shown, base.cases().size()));
  return kNothingFound;
}

int show_case(const CasesArguments& arguments) {
  const CaseBase base = read_case_base(arguments.path());
  const Case& c = base.at(arguments.id);
  print_case(base, c, arguments, case_text(base, c));
  return kNothingFound;
}

int add_case(const CasesArguments& arguments) {
  FileUse()
      .reads("the report", arguments.diagnosis)
      .writes_case_base("the case base", arguments.path())
      .claim();
  return change_and_print(arguments, [&](CaseBase& base) {
    const auto id = base.retain(new_case(arguments, base));
    if (arguments.label()) base.confirm(id, arguments.label());
    return id;
  });
}

int confirm_case(const CasesArguments& arguments) {
  return change_and_print(arguments, [&](CaseBase& base) {
    base.confirm(arguments.id, arguments.label(), arguments.done);
    return arguments.id;
  });
}

int reject_case(const CasesArguments& arguments) {
  return change_and_print(arguments, [&](CaseBase& base) {
    base.reject(arguments.id, arguments.label(), arguments.done);
    return arguments.id;
  });
}

int export_cases(const CasesArguments& arguments) {
  FileUse().reads(ModelPaths{arguments.model, arguments.path()}).writes("-o", arguments.file).claim();
  write_file(arguments.file, to_cases_json(read_case_base(arguments.path())));
  return kNothingFound;
}

int import_cases(const CasesArguments& arguments) {
  FileUse()
      .reads("the export", arguments.file)
      .reads("the model", arguments.model)
      .writes_case_base("the case base", arguments.path())
      .claim();
  CaseBase imported = from_cases_json(read_file(arguments.file), arguments.file);
  if (!arguments.model.empty() && !arguments.merge) imported.belong_to(load_model(arguments.model).identity);
  const std::string path = arguments.path();
  std::int64_t added = std::ssize(imported.cases());
  if (arguments.merge)
    change_case_base(path, [&](CaseBase& base) { added = base.merge(imported); });
  else if (has_case_base(path) && !arguments.replace)
    throw Error(ErrorCode::usage, path, "is there already; choose --merge to add to it or --replace");
  else
    write_case_base(path, imported);
  const nlohmann::ordered_json json = {{"read", imported.cases().size()}, {"added", added}};
  print(arguments.json ? json.dump(2) + "\n"
                       : fmt::format("{} cases read, {} added\n", imported.cases().size(), added));
  return kNothingFound;
}

}  // namespace faultline
