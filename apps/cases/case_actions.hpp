// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/work/file_use.hpp"
#include "lib/cases/case_base.hpp"

/// The actions of faultline cases without their output.
namespace faultline {

/// Returns the date or, if it is empty, today's: from SOURCE_DATE_EPOCH (UTC) if that is set, else from the
/// clock of this machine. Throws Error(usage) for a date not of the form YYYY-MM-DD or an invalid epoch.
std::string date_or_today(const std::string& date);

/// Arguments of the actions of faultline cases.
struct CasesArguments : ModelPaths {
  std::int64_t id = 0;
  std::string fault, outcome, origin, done, by, date, robot, diagnosis, file = "-";
  std::string diagnosis_text;  ///< a diagnosis as JSON instead of the file `diagnosis`
  int joint_number = 0, fault_id = 1;
  bool replace = false, merge = false, confirmed = false;

  /// Path of the case base. Throws Error(usage) unless either it or its model was given.
  std::string path() const;
  /// Throws Error(usage) for a joint without a fault, and for a fault that the base's robot cannot have.
  std::optional<FaultLabel> label(const CaseBase& base) const;
};

/// The result of an action, for programs and for people.
struct CasesAnswer {
  nlohmann::ordered_json json;  ///< null for an action without a result
  std::string text;
  std::string note{};  ///< an unexpected effect to report to the user; may be empty
};

/// Returns a case as an answer; its line begins with `before`.
CasesAnswer answer_with(const CaseBase& base, const Case& c, const std::string& before = "");

// One function per action.
CasesAnswer list_cases(const CasesArguments& arguments);
CasesAnswer show_case(const CasesArguments& arguments);
CasesAnswer add_case(const CasesArguments& arguments);
CasesAnswer confirm_case(const CasesArguments& arguments);
CasesAnswer reject_case(const CasesArguments& arguments);
CasesAnswer delete_case(const CasesArguments& arguments);
CasesAnswer export_cases(const CasesArguments& arguments);
CasesAnswer import_cases(const CasesArguments& arguments);

}  // namespace faultline
