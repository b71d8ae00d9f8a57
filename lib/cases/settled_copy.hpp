// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace faultline {

/// True when a journal lies beside the SQLite file: a change is under way, or was interrupted.
bool has_journal(const std::string& path);

/// Removes the journals that a file which is no more has left behind: SQLite would play them into the next
/// one of that name.
void remove_journals(const std::string& path);

/// A private copy of an SQLite file and its journals, in which SQLite may roll an interrupted change back
/// while the file itself stays as it is, whoever may write it. Removed when the object dies.
class SettledCopy {
 public:
  /// Throws Error(input) when the file, or a folder for temporary files, cannot be used.
  explicit SettledCopy(const std::string& path);
  ~SettledCopy();
  SettledCopy(const SettledCopy&) = delete;
  SettledCopy& operator=(const SettledCopy&) = delete;

  std::string path() const { return folder_ + "/copy.db"; }
  /// False when somebody changed the file while it was copied: then the copy is to be made again.
  bool is_of_one_moment() const { return of_one_moment_; }

 private:
  std::string folder_;
  bool of_one_moment_ = false;
};

}  // namespace faultline
