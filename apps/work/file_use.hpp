// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

namespace faultline {

/// A model and its case base.
struct ModelPaths {
  std::string model;
  std::string cases;  ///< empty: beside the model

  std::string case_base() const;
};

/// The files that a command will read and write. Ensures that no result replaces an input, a file that
/// belongs to an input, or another result; nor, by their names, a case base, the journal of a batch or golden
/// logs, even if the command does not read them. Empty paths are ignored.
class FileUse {
 public:
  /// `what` is its name for the user: "the log". A path that does not exist is no input, such as the axes
  /// RRP. Of a log, the data files beside it are inputs as well.
  FileUse& reads(const std::string& what, const std::string& path);
  FileUse& reads(const std::string& what, const std::vector<std::string>& paths);
  /// The model and its case base, with the journals of SQLite beside it, existing or not.
  FileUse& reads(const ModelPaths& paths);
  /// All files below the folder.
  FileUse& reads_below(const std::string& what, const std::string& folder);

  /// `option` is its name for the user: "--json". A path - is standard output.
  FileUse& writes(const std::string& option, const std::string& path);
  /// A file that faultline keeps for later, such as golden.toml, written by the command that creates it.
  FileUse& writes_kept(const std::string& option, const std::string& path);
  /// A case base with its journals.
  FileUse& writes_case_base(const std::string& option, const std::string& path);
  /// Files below the folder, all or those with this extension.
  FileUse& writes_below(const std::string& option, const std::string& folder,
                        const std::string& extension = "");

  /// Call it before any computation. Throws Error(usage) when a result would replace another file; then
  /// removes partly written files of killed programs from the folders of the results.
  void claim() const;

 private:
  struct Named {
    std::string what;
    std::string path;
    std::string identity{};   ///< see file_identity(); empty for a target that several may share
    std::string extension{};  ///< for a folder: extension of its files
    bool is_kept = false;     ///< see writes_kept()
  };

  void add_output(Named output);
  void keep(const std::string& what, const std::string& path);
  void check_output(const Named& output) const;
  void check_folder(const Named& folder) const;
  void check_standard_output() const;

  std::unordered_map<std::string, Named> inputs_;  ///< by identity
  std::vector<Named> input_folders_, outputs_, output_folders_;
};

/// Creates the folder for results, with its parents, if it does not exist. Throws Error(output).
void make_folder(const std::string& folder);

}  // namespace faultline
