// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/work/model_paths.hpp"
#include "lib/cases/case_base.hpp"

/// The actions of faultline cases without what they print.
namespace faultline {

/// What the actions of faultline cases are asked for.
struct CasesArguments : ModelPaths {
  std::int64_t id = 0;
  std::string fault, outcome, origin, done, by, date, robot, diagnosis, file = "-";
  std::string diagnosis_text;  ///< a diagnosis as JSON in place of the file of that name
  int joint = 0, fault_id = 1;
  bool replace = false, merge = false, confirmed = false;

  /// Of the case base. Throws Error(usage) unless either it or its model was named.
  std::string path() const;
  /// Throws Error(usage) for a joint without a fault, and for a fault that the robot of the base cannot have.
  std::optional<FaultLabel> label(const CaseBase& base) const;
};

/// What an action did, for programs and for people.
struct CasesAnswer {
  nlohmann::ordered_json json;  ///< null where there is nothing to tell
  std::string text;
  std::string note{};  ///< what the user would not expect; empty: nothing
};

/// A case as an answer; `before` begins its line.
CasesAnswer answer_with(const CaseBase& base, const Case& c, const std::string& before = "");

// One function an action.
CasesAnswer list_cases(const CasesArguments& arguments);
CasesAnswer show_case(const CasesArguments& arguments);
CasesAnswer add_case(const CasesArguments& arguments);
CasesAnswer confirm_case(const CasesArguments& arguments);
CasesAnswer reject_case(const CasesArguments& arguments);
CasesAnswer delete_case(const CasesArguments& arguments);
CasesAnswer export_cases(const CasesArguments& arguments);
CasesAnswer import_cases(const CasesArguments& arguments);

}  // namespace faultline
