// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "lib/core/files/removed_on_signal.hpp"

namespace faultline {

/// An empty file beside `target`, under an unpredictable name (NAME.partial-..), which replaces target by
/// commit() or is removed with the object, or with the program if a signal ends it. It is locked while the
/// object exists, which distinguishes it from the files of killed programs; the first one in a folder removes
/// those. Symbolic links at `target` are followed. An existing file keeps its mode, and its owner if
/// permitted. Every failure throws Error(output) naming `target`.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::string target);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }
  int descriptor() const { return descriptor_; }  ///< for reading and writing
  /// Ensures that bytes and name are on the disk.
  void commit();

 private:
  bool create();
  void take_over_mode();
  void remove();
  [[noreturn]] void fail(const char* doing);

  std::string target_;  ///< as the user gave it
  std::string place_;   ///< behind all links
  std::string path_;    ///< empty once renamed or removed
  std::unique_ptr<RemovedOnSignal> on_signal_;
  int descriptor_ = -1;
};

/// Removes half-written files of dead programs from the folder; those that cannot be removed stay. Has an
/// effect once per folder and process.
void remove_abandoned_files(const std::string& folder);

/// Throws Error(output) stating why `path` cannot be `doing` ("created", ..), by errno.
[[noreturn]] void fail_to_write(const std::string& path, const char* doing);

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
