// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/cases/case_base.hpp"

namespace faultline {

/// SHA-256 of metric, robot and all cases with their ids, the same on every machine. Bases that tell nothing
/// of what cases did not know in earlier programs keep the hash that they had there.
std::string content_hash(const CaseBase& base);

/// Of all of a case but its id.
std::string content_hash(const Case& c);

}  // namespace faultline
