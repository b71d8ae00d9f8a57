// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace faultline {

/// A fresh name beside `path` that nobody can foretell: NAME.partial-MMMMMMMMRRRRRRRRRRRRRRRR, with M of this
/// machine's name and R random, in hexadecimal digits. A NAME too long for that is cut.
std::string temporary_name(const std::string& path);

/// Which program a temporary name is of.
enum class TemporaryKind {
  none,           ///< no temporary name
  this_machine,   ///< a living program there holds a lock on its file
  other_machine,  ///< perhaps alive where its locks are not seen from here
  earlier,        ///< of a version of the program that locked nothing
};
TemporaryKind temporary_kind(std::string_view name);
bool is_temporary_name(std::string_view name);

/// The process that a name of an earlier version tells of.
long long process_of(std::string_view earlier_name);

}  // namespace faultline
