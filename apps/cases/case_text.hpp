// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/cases/case_base.hpp"

namespace faultline {

/// A case in one line of a list, with where it comes from.
std::string case_line(const CaseBase& base, const Case& c);

/// A case with opinions, evidence and features; `base` tells their names, scales and weights.
std::string case_text(const CaseBase& base, const Case& c);

}  // namespace faultline
