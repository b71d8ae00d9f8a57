// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/cases/case_base.hpp"

namespace faultline {

int joints_of(const CaseBase& base);

/// Throws Error(usage) with `where` if a robot with `joints` joints does not have the label's joint.
void check_joint(int joints, const FaultLabel& label, const std::string& where);

/// As check_joint(); also checks that the label has a joint if its kind is a fault of a joint, and only then.
void check_place(int joints, const FaultLabel& label, const std::string& where);

/// As check_place() for the robot of a base; also checks that the base's model has the label as a hypothesis,
/// or that the base has a case of this kind.
void check_label(const CaseBase& base, const FaultLabel& label, const std::string& where);

/// Returns the label with the last joint if it is a changed payload without a link.
FaultLabel with_tip(FaultLabel label, int joints);

}  // namespace faultline
