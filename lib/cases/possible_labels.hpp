// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/cases/case_base.hpp"

namespace faultline {

/// Joints of the robot of the base, by its axes or by what is compared of each joint; 0 where neither tells.
int joints_of(const CaseBase& base);

/// Throws Error(usage) with `where` for a joint that a robot of so many does not have; 0: how many is not
/// known.
void check_joint(int joints, const FaultLabel& label, const std::string& where);

/// The same, and that a joint is told where the fault is one of a joint, and only there.
void check_place(int joints, const FaultLabel& label, const std::string& where);

/// The same for the robot of a base, and that some fault of this kind is known for it: as a hypothesis of its
/// model, or by a case.
void check_label(const CaseBase& base, const FaultLabel& label, const std::string& where);

/// The label with the last joint where it is a changed payload whose link was left out.
FaultLabel with_tip(FaultLabel label, int joints);

}  // namespace faultline
