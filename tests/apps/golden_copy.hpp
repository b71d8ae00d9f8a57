// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "lib/core/atomic_file.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {

/// A copy of sample_logs/golden that a test may break.
class GoldenCopy {
 public:
  GoldenCopy() {
    std::filesystem::copy(FAULTLINE_SOURCE_DIR "/sample_logs/golden", path(),
                          std::filesystem::copy_options::recursive);
  }

  std::string path() const { return folder_.file("golden"); }
  std::string toml() const { return path() + "/golden.toml"; }
  std::string outside(const std::string& name) const { return folder_.file(name); }

  ProgramRun run(const std::string& action, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"golden", action, path()});
    return run_program(more);
  }

  /// Replaces the first `from` in golden.toml; throws when it is not there.
  void edit(const std::string& from, const std::string& to) const {
    std::string text = read_file(toml());
    text.replace(text.find(from), from.size(), to);
    write_file(toml(), text);
  }

  /// The one file of that folder whose name begins so.
  std::string file(const std::string& folder, const std::string& beginning) const {
    for (const auto& entry : std::filesystem::directory_iterator(path() + "/" + folder))
      if (entry.path().filename().string().rfind(beginning, 0) == 0) return entry.path().string();
    return "";
  }

  /// The bytes and the time stamp of every file.
  std::map<std::string, std::pair<std::string, std::filesystem::file_time_type>> snapshot() const {
    std::map<std::string, std::pair<std::string, std::filesystem::file_time_type>> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path()))
      if (entry.is_regular_file())
        files[entry.path().string()] = {read_file(entry.path().string()), entry.last_write_time()};
    return files;
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace faultline
