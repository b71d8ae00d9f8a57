// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/model/twin/twin_options.hpp"

namespace faultline {

/// Returns the distribution of the simulated runs as a table for people.
std::string twin_text(const TwinOptions& options);

}  // namespace faultline
