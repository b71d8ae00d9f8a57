// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "apps/options.hpp"
#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// What the actions of faultline cases are asked for.
struct CasesArguments : ModelPaths {
  bool json = false;
  std::int64_t id = 0;
  std::string fault, outcome, done, diagnosis, file = "-";
  int joint = 0, fault_id = 1;
  bool replace = false, merge = false;

  /// Of the case base. Throws Error(usage) unless either it or its model was named.
  std::string path() const;
  /// Throws Error(usage) for a joint without a fault.
  std::optional<FaultLabel> label() const;
};

// One function an action; each returns the exit status.
int list_cases(const CasesArguments& arguments);
int show_case(const CasesArguments& arguments);
int add_case(const CasesArguments& arguments);
int confirm_case(const CasesArguments& arguments);
int reject_case(const CasesArguments& arguments);
int export_cases(const CasesArguments& arguments);
int import_cases(const CasesArguments& arguments);

}  // namespace faultline
