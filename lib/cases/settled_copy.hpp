// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace faultline {

/// Whether a journal lies beside the SQLite file: a change is in progress or was interrupted.
bool has_journal(const std::string& path);

/// Removes the journals that a deleted file has left behind, which SQLite would apply to the next file of
/// that name.
void remove_journals(const std::string& path);

/// A private copy of an SQLite file and its journals, in which SQLite may roll back an interrupted change
/// without changing the file itself. Removed with the object.
class SettledCopy {
 public:
  /// Throws Error(input) if the file, or a folder for temporary files, cannot be used.
  explicit SettledCopy(const std::string& path);
  ~SettledCopy();
  SettledCopy(const SettledCopy&) = delete;
  SettledCopy& operator=(const SettledCopy&) = delete;

  std::string path() const { return folder_ + "/copy.db"; }
  /// False if the file changed while it was copied; then copy it again.
  bool is_of_one_moment() const { return of_one_moment_; }

 private:
  std::string folder_;
  bool of_one_moment_ = false;
};

}  // namespace faultline
