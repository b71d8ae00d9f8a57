// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/cases/case_base.hpp"

namespace faultline {

/// SHA-256 of metric, robot and all cases with their ids, the same on every machine.
std::string content_hash(const CaseBase& base);

/// SHA-256 of a case without its id.
std::string content_hash(const Case& c);

}  // namespace faultline
