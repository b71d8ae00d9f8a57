// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace faultline {

/// Returns a new unpredictable name beside `path`: NAME.partial-MMMMMMMMRRRRRRRRRRRRRRRR, with M from the
/// name of this machine and R random, in hexadecimal digits. A NAME too long for that is cut.
std::string temporary_name(const std::string& path);

/// Origin of a temporary name.
enum class TemporaryKind {
  none,           ///< not a temporary name
  this_machine,   ///< of this machine: a running program holds a lock on its file
  other_machine,  ///< perhaps of a running program whose locks are not visible here
};
TemporaryKind temporary_kind(std::string_view name);
bool is_temporary_name(std::string_view name);

}  // namespace faultline
