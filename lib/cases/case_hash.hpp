// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/cases/case_base.hpp"

namespace faultline {

/// SHA-256 of metric, robot and all cases with their ids, the same on every machine. A base without any field
/// that early programs did not have keeps its early hash.
std::string content_hash(const CaseBase& base);

/// SHA-256 of a case without its id.
std::string content_hash(const Case& c);

}  // namespace faultline
