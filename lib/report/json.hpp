// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/diagnose/diagnosis.hpp"

namespace faultline {

/// Schema "faultline/diagnosis/1" (docs/report.md): two-space indented, keys always all there and in the same
/// order, NaN as null, text as valid UTF-8. The same Diagnosis gives the same bytes.
std::string render_json(const Diagnosis& diagnosis);

}  // namespace faultline
