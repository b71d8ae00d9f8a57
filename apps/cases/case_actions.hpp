// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "apps/options.hpp"
#include "lib/cases/case_base.hpp"

namespace faultline {

/// What the actions of faultline cases are asked for.
struct CasesArguments : ModelPaths {
  bool json = false;
  std::int64_t id = 0;
  std::string fault, outcome, origin, done, by, date, robot, diagnosis, file = "-";
  int joint = 0, fault_id = 1;
  bool replace = false, merge = false, confirmed = false;

  /// Of the case base. Throws Error(usage) unless either it or its model was named.
  std::string path() const;
  /// Throws Error(usage) for a joint without a fault, and for a fault that the robot of the base cannot have.
  std::optional<FaultLabel> label(const CaseBase& base) const;
};

void print_case(const CaseBase& base, const Case& c, const CasesArguments& arguments,
                const std::string& text);

// One function an action; each returns the exit status.
int list_cases(const CasesArguments& arguments);
int show_case(const CasesArguments& arguments);
int add_case(const CasesArguments& arguments);
int confirm_case(const CasesArguments& arguments);
int reject_case(const CasesArguments& arguments);
int delete_case(const CasesArguments& arguments);
int export_cases(const CasesArguments& arguments);
int import_cases(const CasesArguments& arguments);

}  // namespace faultline
