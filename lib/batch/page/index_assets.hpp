// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

/// What is put into every index, embedded when the program is built (embed_assets.cmake).
namespace faultline {

std::string_view index_style();
std::string_view index_script();

}  // namespace faultline
