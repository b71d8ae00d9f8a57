// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/golden/check.hpp"

namespace faultline {

/// Schema "faultline/golden-check/1" (docs/golden.md): the differences, and all that the run says, so that
/// golden compare can set it against a run of another program version. NaN is null.
std::string render_check_json(const GoldenCheck& check, const GoldenRun& run);

/// The run out of such a text. Throws Error(input) for text that is none.
GoldenRun run_from_json(const std::string& text, const std::string& where);

}  // namespace faultline
