// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/cases/case.hpp"

namespace faultline {

/// The fault with this id in a JSON report (render_json) as an unconfirmed case for a case base that compares
/// `feature_names`; its origin is the log's path, its robot that of the model. Throws Error(input) with
/// `where` when the text is no diagnosis or the features differ, Error(usage) when it has no such fault.
Case case_from_json(const std::string& text, const std::string& where, int fault_id,
                    const std::vector<std::string>& feature_names);

}  // namespace faultline
