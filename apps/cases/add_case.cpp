// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <limits>

#include "apps/cases/case_actions.hpp"
#include "apps/work/file_use.hpp"
#include "lib/cases/case.hpp"
#include "lib/cases/case_base.hpp"
#include "lib/cases/case_file.hpp"
#include "lib/cases/possible_labels.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/report/case_from_json.hpp"

namespace faultline {
namespace {

Case case_told(const CasesArguments& arguments, const CaseBase& base) {
  if (!arguments.diagnosis_text.empty())
    return case_from_json(arguments.diagnosis_text, "the diagnosis", arguments.fault_id,
                          base.feature_names());
  if (!arguments.diagnosis.empty())
    return case_from_json(read_file(arguments.diagnosis), arguments.diagnosis, arguments.fault_id,
                          base.feature_names());
  const auto label = arguments.label(base);
  if (!label)
    throw Error(ErrorCode::usage, "faultline cases add", "needs a diagnosis (JSON report) or --fault KIND");
  Case c;
  c.decision = *label;
  c.episode.features.assign(base.metric().features.size(), std::numeric_limits<double>::quiet_NaN());
  c.origin = kByHandOrigin;
  c.robot = base.robot().name;
  return c;
}

Case new_case(const CasesArguments& arguments, const CaseBase& base) {
  Case c = case_told(arguments, base);
  check_joint(joints_of(base), c.decision, arguments.diagnosis);
  if (const auto label = arguments.label(base)) {
    c.label = *label;
    c.outcome = CaseOutcome::confirmed;
  }
  c.what_was_done = arguments.done;
  c.person = arguments.by;
  c.date = date_or_today(arguments.date);
  if (!arguments.robot.empty()) c.robot = arguments.robot;
  return c;
}

void change(std::string& there, const std::string& stated, const char* what,
            std::vector<std::string>& changes) {
  if (stated.empty() || there == stated) return;
  there = stated;
  changes.push_back(what);
}

/// An existing case of the same event, with the new statements about it.
struct Restated {
  Case revised;
  std::vector<std::string> changes;  ///< empty: nothing new
};

Restated restated(const Case& there, const Case& c, const CasesArguments& arguments) {
  Restated out{there, {}};
  Case& revised = out.revised;
  if (c.outcome == CaseOutcome::confirmed &&
      (there.outcome != CaseOutcome::confirmed || there.label != c.label)) {
    revised.outcome = c.outcome;
    revised.label = c.label;
    revised.person = c.person;
    revised.date = c.date;
    out.changes.push_back(fmt::format("now confirmed as \"{}\" (was {}, \"{}\")", plain_words(c.label),
                                      to_string(there.outcome), plain_words(there.label)));
  }
  change(revised.what_was_done, arguments.done, "what was done", out.changes);
  change(revised.person, arguments.by, "by whom", out.changes);
  change(revised.date, arguments.date, "the date", out.changes);
  change(revised.robot, arguments.robot, "the robot", out.changes);
  return out;
}

struct Added {
  std::int64_t id = 0;
  std::string message;     ///< an unexpected effect to report; empty: a new case
  bool is_changed = true;  ///< the base is changed
};

Added add_to(CaseBase& base, const CasesArguments& arguments) {
  const Case c = new_case(arguments, base);
  if (const Case* there = find_same_event(base, c)) {
    const Restated found = restated(*there, c, arguments);
    const std::string which =
        fmt::format("this event is already case {} (the same log, onset and fault)", there->id);
    if (found.changes.empty()) return {there->id, which + "; nothing was changed", false};
    base.replace(found.revised);
    return {found.revised.id, fmt::format("{}; changed: {}", which, fmt::join(found.changes, ", ")), true};
  }
  const bool by_hand = c.origin == kByHandOrigin;
  return {base.retain(c),
          by_hand ? "the case has no measured features, so no diagnosis will find it similar" : "", true};
}

}  // namespace

CasesAnswer add_case(const CasesArguments& arguments) {
  FileUse()
      .reads("the report", arguments.diagnosis)
      .writes_case_base("the case base", arguments.path())
      .claim();
  CaseBase base = read_case_base(arguments.path());
  Added added = add_to(base, arguments);
  if (added.is_changed)
    change_case_base(arguments.path(), [&](CaseBase& there) {
      added = add_to(there, arguments);
      base = there;
    });
  CasesAnswer answer = answer_with(base, base.at(added.id));
  answer.note = added.message;
  return answer;
}

}  // namespace faultline
