// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace faultline {

/// Whether a batch has written there.
bool is_batch_folder(const std::string& folder);

/// The folder of a batch's results, held so that no second batch writes into it. Throws Error(output) when it
/// cannot be made or written, Error(usage) when it holds something else, Error(input) when a link, a pipe or
/// a device is in the place of one of its files (inner_file.hpp): a folder of results may come from another
/// person.
class BatchFolder {
 public:
  /// With `wait`, waits for another batch there to end; else that is an Error(output).
  BatchFolder(std::string folder, bool wait);
  ~BatchFolder();
  BatchFolder(const BatchFolder&) = delete;
  BatchFolder& operator=(const BatchFolder&) = delete;

  /// Path of a file in it, such as "index.csv" or "logs/run-1.json".
  std::string file(const std::string& name) const { return path_ + "/" + name; }
  /// Of a regular file in it, by such a name; see inner_file.hpp.
  bool has(const std::string& name) const;
  std::string read(const std::string& name) const;
  void write(const std::string& name, std::string_view bytes) const;
  /// The same for one of many files, which sync() brings to the disk at once: a kill can leave it half
  /// written.
  void write_unsynced(const std::string& name, std::string_view bytes) const;
  void sync() const;
  std::string journal() const { return file(".batch/journal"); }
  std::string known_logs() const { return file(".batch/known_logs"); }
  std::string finished() const { return file(".batch/finished.json"); }
  /// To be done before anything in it changes: what is there is no finished batch any more.
  void mark_unfinished() const;
  /// Removes what a killed batch left half written and results, by name in logs/, that are not in `results`.
  void clean(const std::set<std::string>& results) const;

 private:
  void refuse_foreign_places() const;
  void lock(bool wait);

  std::string path_;
  int lock_ = -1;
};

}  // namespace faultline
