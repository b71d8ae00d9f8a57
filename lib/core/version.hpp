// SPDX-License-Identifier: MIT
#pragma once

namespace faultline {

/// Of this program, such as "0.1.0".
const char* program_version();

}  // namespace faultline
