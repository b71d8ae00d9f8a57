// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "apps/service/pages/pages.hpp"

namespace faultline {

/// What a user states about a fault of a diagnosed log.
struct CaseStatement {
  int fault_id = 0;
  std::string kind, what_was_done, person;
  int joint_number = 0;  ///< 0: none
};

/// Adds the fault of a diagnosis in `job_folder` to the case base of `model`, confirmed with this statement,
/// and remembers the case in the folder. When it returns, the case survives a loss of power. A later
/// statement about the same event replaces the earlier one. Throws as faultline cases add, such as for a
/// joint that the robot does not have.
void state_case(const std::string& model, const std::string& job_folder, const CaseStatement& statement);

/// The cases of the faults of a job, by fault, as they stand in the case base now. Throws Error(input) if it
/// cannot be read.
std::vector<StatedCase> stated_cases(const std::string& model, const std::string& job_folder);

}  // namespace faultline
