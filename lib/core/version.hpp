// SPDX-License-Identifier: MIT
#pragma once

namespace faultline {

/// Returns the version of this program, such as "0.1.0".
const char* program_version();

}  // namespace faultline
