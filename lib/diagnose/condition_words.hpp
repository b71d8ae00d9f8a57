// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace faultline {

/// Returns the words for the name of a condition item: "friction of joint 1" for "friction_1"; the name
/// itself if it is none of those that a diagnosis lists.
std::string condition_words(const std::string& name);

}  // namespace faultline
