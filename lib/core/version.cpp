// SPDX-License-Identifier: MIT
#include "lib/core/version.hpp"

namespace faultline {

const char* program_version() { return FAULTLINE_VERSION; }

}  // namespace faultline
