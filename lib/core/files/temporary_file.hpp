// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "lib/core/files/removed_on_signal.hpp"

namespace faultline {

/// An empty file beside `target`, under a name that nobody can foretell (NAME.partial-..), which takes
/// target's place by commit() or vanishes with the object, or with the program when a signal ends it. It is
/// locked as long as it lives, so that what a killed program left is told from what another one writes; the
/// first one in a folder removes what dead programs left there. Symbolic links at `target` are followed. A
/// file that is there already keeps its mode and owner. Every failure throws Error(output) naming `target`.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::string target);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }
  int descriptor() const { return descriptor_; }  ///< for reading and writing
  /// Puts bytes and name safely on the disk.
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

/// Removes what programs that are dead left half written in the folder; what cannot be removed stays. Once a
/// folder and process.
void remove_abandoned_files(const std::string& folder);

/// Throws Error(output) that says why `path` cannot be `doing` ("created", ..), by errno.
[[noreturn]] void fail_to_write(const std::string& path, const char* doing);

}  // namespace faultline
