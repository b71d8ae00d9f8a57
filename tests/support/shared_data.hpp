// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace faultline {

/// The folder of recorded logs that lies beside the project on some machines: the environment variable
/// FAULTLINE_SHARED_DATA, else ../shared/data. Empty, after saying so on standard output, when it is absent.
std::filesystem::path shared_data();

}  // namespace faultline
