// SPDX-License-Identifier: MIT
#include "apps/work/file_use.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <regex>

#include "formats/open_log.hpp"
#include "lib/cases/case_file.hpp"
#include "lib/cases/sqlite.hpp"
#include "lib/core/error.hpp"
#include "lib/core/files/output_place.hpp"
#include "lib/core/files/temporary_file.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

std::string folder_of(const std::string& path) {
  const std::string folder = fs::path(output_place(path).path).parent_path().string();
  return folder.empty() ? "." : folder;
}

bool is_golden_folder(const fs::path& folder) {
  std::error_code ignored;
  return fs::exists(folder / "golden.toml", ignored);
}

/// Returns what faultline stores under this name, for any model, batch or golden folder; empty for other
/// files. A wrong file in place of a journal would damage the case base, so these names are reserved even
/// without a file.
std::string kept_under(const std::string& path) {
  static const std::regex case_base(R"(.+\.cases\.db(-journal|-wal|-shm)?)"),
      golden(R"(golden\.toml|model-[0-9a-f]{8}\.json|cases-[0-9a-f]{8}\.db(-journal|-wal|-shm)?)");
  const fs::path real = real_path(path), folder = real.parent_path(), part = folder.filename();
  const std::string name = real.filename().string();
  if (std::regex_match(name, case_base)) return "the case base of a model";
  std::error_code ignored;
  if (!fs::exists(real, ignored)) return "";
  if (part == ".batch") return "the journal of a batch";
  const bool is_golden = std::regex_match(name, golden) && is_golden_folder(folder);
  const bool is_golden_log = (part == "logs" || part == "traces") && is_golden_folder(folder.parent_path());
  return is_golden || is_golden_log ? "a file of golden logs" : "";
}

bool is_below(const std::string& real, const std::string& real_folder) {
  return real.starts_with(real_folder + "/");
}

[[noreturn]] void refuse(const std::string& option, const std::string& path, const std::string& why) {
  throw Error(ErrorCode::usage, option + " " + path, why);
}

}  // namespace

std::string ModelPaths::case_base() const { return cases.empty() ? case_base_path(model) : cases; }

void FileUse::keep(const std::string& what, const std::string& path) {
  const std::string identity = path.empty() ? "" : file_identity(path);
  if (!identity.empty()) inputs_.try_emplace(identity, Named{what, path, identity});
}

FileUse& FileUse::reads(const std::string& what, const std::string& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return *this;
  keep(what, path);
  for (const std::string& data : files_beside(path)) keep("the data file of " + what, data);
  return *this;
}

FileUse& FileUse::reads(const std::string& what, const std::vector<std::string>& paths) {
  for (const std::string& path : paths) reads(what, path);
  return *this;
}

FileUse& FileUse::reads(const ModelPaths& paths) {
  if (!paths.model.empty()) reads("the model", paths.model);
  if (paths.model.empty() && paths.cases.empty()) return *this;
  for (const std::string& file : sqlite_files(paths.case_base()))
    keep(file == paths.case_base() ? "the case base" : "the case base's journal", file);
  return *this;
}

FileUse& FileUse::reads_below(const std::string& what, const std::string& folder) {
  input_folders_.push_back({what, folder});
  return *this;
}

void FileUse::add_output(Named output) {
  if (output.path.empty()) return;
  output.identity = output.path == "-" ? output.path : file_identity(output.path);
  outputs_.push_back(std::move(output));
}

FileUse& FileUse::writes(const std::string& option, const std::string& path) {
  add_output({option, path});
  return *this;
}

FileUse& FileUse::writes_kept(const std::string& option, const std::string& path) {
  add_output({.what = option, .path = path, .is_kept = true});
  return *this;
}

FileUse& FileUse::writes_case_base(const std::string& option, const std::string& path) {
  for (const std::string& file : sqlite_files(path)) writes_kept(option, file);
  return *this;
}

FileUse& FileUse::writes_below(const std::string& option, const std::string& folder,
                               const std::string& extension) {
  if (!folder.empty()) output_folders_.push_back({option, folder, "", extension});
  return *this;
}

void FileUse::check_output(const Named& output) const {
  if (output.identity.empty()) return;
  const auto input = inputs_.find(output.identity);
  if (input != inputs_.end())
    refuse(output.what, output.path,
           "would overwrite " + input->second.what + " " + input->second.path + "; give another name");
  for (const Named& folder : input_folders_)
    if (output.path != "-" && is_below(real_path(output.path), real_path(folder.path)))
      refuse(output.what, output.path,
             "lies among " + folder.what + " in " + folder.path + "; give another name");
  for (const Named& other : outputs_) {
    if (&other == &output) break;
    if (other.identity == output.identity)
      refuse(output.what, output.path,
             "is also the file of " + other.what + "; give each result its own file");
  }
  if (const std::string kept = output.is_kept || output.path == "-" ? "" : kept_under(output.path);
      !kept.empty())
    refuse(output.what, output.path, "would replace " + kept + "; give another name");
}

void FileUse::check_folder(const Named& folder) const {
  const std::string real_folder = real_path(folder.path);
  const auto meant = [&](const std::string& path) {
    return (folder.extension.empty() || fs::path(path).extension() == folder.extension) &&
           is_below(real_path(path), real_folder);
  };
  for (const auto& [identity, input] : inputs_)
    if (meant(input.path))
      refuse(folder.what, folder.path,
             "is a folder for results, which could overwrite " + input.what + " " + input.path +
                 " in it; give another folder");
  for (const Named& output : outputs_)
    if (output.path != "-" && !output.identity.empty() && meant(output.path))
      refuse(output.what, output.path,
             "lies among the files that " + folder.what + " writes; give another name");
}

/// Checks that the shell did not redirect standard output into one of the files.
void FileUse::check_standard_output() const {
  struct stat facts {};
  if (::fstat(STDOUT_FILENO, &facts) != 0 || !S_ISREG(facts.st_mode)) return;
  const std::string identity = std::to_string(facts.st_dev) + ":" + std::to_string(facts.st_ino);
  const std::string what = "is redirected into ";
  if (const auto input = inputs_.find(identity); input != inputs_.end())
    throw Error(ErrorCode::usage, "standard output",
                what + input->second.what + " " + input->second.path + "; redirect it elsewhere");
  for (const Named& output : outputs_)
    if (output.identity == identity)
      throw Error(ErrorCode::usage, "standard output",
                  what + "the file of " + output.what + "; give " + output.what + " - alone");
}

void FileUse::claim() const {
  for (const Named& output : outputs_) check_output(output);
  for (const Named& folder : output_folders_) check_folder(folder);
  check_standard_output();
  for (const Named& output : outputs_)
    if (output.path != "-" && !output.identity.empty()) remove_abandoned_files(folder_of(output.path));
  for (const Named& folder : output_folders_) remove_abandoned_files(folder.path);
}

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    throw Error(ErrorCode::output, folder,
                "cannot be created as a folder for the results; give another with -o");
}

}  // namespace faultline
