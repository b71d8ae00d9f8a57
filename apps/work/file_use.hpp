// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "apps/work/model_paths.hpp"

namespace faultline {

/// The files that a command is about to read and write, so that none of its results takes the place of an
/// input, of a file that belongs to an input, or of another result; nor, known by their names, of a case
/// base, the journal of a batch or golden logs, even if the command does not read them. Empty paths are
/// passed over.
class FileUse {
 public:
  /// `what` names it to the user: "the log". A path that is not there is no input, as the axes RRP.
  FileUse& reads(const std::string& what, const std::string& path);
  FileUse& reads(const std::string& what, const std::vector<std::string>& paths);
  /// The model and its case base, with the journals that SQLite keeps beside it, there or not.
  FileUse& reads(const ModelPaths& paths);
  /// All that lies below the folder.
  FileUse& reads_below(const std::string& what, const std::string& folder);

  /// `option` names it to the user: "--json". A path - is standard output.
  FileUse& writes(const std::string& option, const std::string& path);
  /// A file that faultline keeps for later, such as golden.toml, by the command that makes it.
  FileUse& writes_kept(const std::string& option, const std::string& path);
  /// A case base with its journals.
  FileUse& writes_case_base(const std::string& option, const std::string& path);
  /// Files below the folder, those with this extension only, or all.
  FileUse& writes_below(const std::string& option, const std::string& folder,
                        const std::string& extension = "");

  /// To be called before anything is computed. Throws Error(usage) when a result would take another file's
  /// place; then removes what programs that were killed left half written in the folders of the results.
  void claim() const;

 private:
  struct Named {
    std::string what;
    std::string path;
    std::string identity{};   ///< see file_identity(); empty for what many may share
    std::string extension{};  ///< of a folder: of the files that are meant
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

}  // namespace faultline
