// SPDX-License-Identifier: MIT
#include "lib/batch/log_result.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>

#include "lib/core/hash.hpp"
#include "lib/core/text.hpp"
#include "lib/identify/identify.hpp"
#include "lib/report/html/html_report.hpp"
#include "lib/report/text.hpp"

namespace faultline {
namespace {

constexpr std::size_t kReadable = 100;  // characters of a log's name in the name of its result
constexpr std::size_t kHash = 12;

std::string joined(const std::string& a, const std::string& b) {
  return std::to_string(a.size()) + " " + a + "\n" + b + "\n";
}

/// From this log alone, on one thread and a limited number of rows: quick, and precise enough for a trend.
/// None where the log does not suffice.
std::vector<ParameterValue> parameters_in(LogSource& log, const Robot& robot) {
  IdentifyOptions options;
  options.threads = 1;
  options.max_rows = 4000;
  options.max_iterations = 12;
  std::vector<ParameterValue> parameters;
  LogSource* const logs[] = {&log};
  log.rewind();
  try {
    for (const ParameterEstimate& p : identify(logs, robot, options).base_parameters)
      if (p.identifiable) parameters.push_back(value_of(p));
  } catch (const Error& error) {
    if (error.code() != ErrorCode::input) throw;
  }
  return parameters;
}

/// Returns the hash of all files of the log.
std::string sha256_of_log(const BatchLog& log) { return sha256_of_files(files_of(log)); }

/// Reads the file a second time only when it was written to meanwhile and may have the same content.
void refuse_changed(const BatchLog& log, const FileStamp& before, const std::string& sha256_read) {
  const FileStamp now = stamp_of(log.path);
  if (now == before || (now.bytes == before.bytes && sha256_of_log(log) == sha256_read)) return;
  throw Error(ErrorCode::input, log.path, "changed while it was read; run again when it is complete");
}

bool is_file_with(const BatchFolder& folder, const std::string& name, const std::string& sha256) {
  return sha256.empty() || (folder.has(name) && sha256_of_file(folder.file(name)) == sha256);
}

std::vector<FileStamp> result_stamps(const JournalEntry& entry, const BatchFolder& folder) {
  std::vector<std::string> paths;
  for (const auto& [sha256, ending] :
       {std::pair(&entry.json_sha, ".json"), std::pair(&entry.html_sha, ".html")})
    if (!sha256->empty()) paths.push_back(folder.file("logs/" + entry.row.result + ending));
  return stamps_of(paths);
}

bool is_intact(const JournalEntry& entry, const BatchFolder& folder) {
  const std::string stem = "logs/" + entry.row.result;
  return is_file_with(folder, stem + ".json", entry.json_sha) &&
         is_file_with(folder, stem + ".html", entry.html_sha);
}

}  // namespace

std::vector<std::string> files_of(const BatchLog& log) {
  std::vector<std::string> paths{log.path};
  paths.insert(paths.end(), log.beside.begin(), log.beside.end());
  return paths;
}

std::string result_name(const std::string& log_name, const std::string& log_sha256) {
  std::string name = log_name.size() > kReadable ? log_name.substr(log_name.size() - kReadable) : log_name;
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) {
    return c < 128 && (std::isalnum(c) || c == '.' || c == '-') ? static_cast<char>(c) : '_';
  });
  while (name.starts_with('.')) name.erase(0, 1);
  return name + "-" + sha256_hex(joined(log_name, log_sha256)).substr(0, kHash);
}

std::string result_key(const std::string& settings, const BatchLog& log, const std::string& log_sha256) {
  return sha256_hex(joined(settings, joined(log.name, log_sha256)));
}

JournalEntry write_log_result(const BatchLog& log, const BatchSetup& setup) {
  const BatchOptions& options = setup.options;
  const FileStamp before = stamp_of(log.path);
  const auto which = static_cast<std::size_t>(log.model);
  const Model& model = setup.models[which].model;
  const auto source = setup.open(log.path, model.robot);
  Diagnosis diagnosis = diagnose(*source, model, setup.models[which].cases, options.diagnose);
  diagnosis.log.path = log.name;
  refuse_changed(log, before, diagnosis.log.sha256);
  JournalEntry entry;
  entry.key = result_key(setup.settings[which], log, diagnosis.log.sha256);
  entry.row = row_of(diagnosis);
  if (options.identify && diagnosis.verdict == Verdict::healthy)
    entry.row.parameters = parameters_in(*source, model.robot);
  entry.row.result = result_name(log.name, diagnosis.log.sha256);
  const std::string stem = "logs/" + entry.row.result;
  if (options.html) {
    const std::string page =
        render_html(diagnosis, report_details(*source, model, diagnosis, options.diagnose));
    refuse_changed(log, before, diagnosis.log.sha256);
    setup.folder.write(stem + ".html", page);
    entry.html_sha = sha256_hex(page);
  }
  const std::string json = render_json(diagnosis);
  setup.folder.write(stem + ".json", json);
  entry.json_sha = sha256_hex(json);
  return entry;
}

JournalEntry unusable_result(const BatchLog& log, const FileStamp& before, const Error& reason,
                             const ModelFacts& model, const std::string& settings) {
  JournalEntry entry;
  entry.row = unusable_row(log.name, log.path, reason, model);
  std::error_code error;
  if (!std::filesystem::is_regular_file(log.path, error)) return entry;
  try {
    entry.row.sha256 = sha256_of_log(log);
  } catch (const Error& unreadable) {
    entry.row = unusable_row(log.name, log.path, unreadable, model);
    return entry;
  }
  if (reason.code() != ErrorCode::internal && stamp_of(log.path) == before)
    entry.key = result_key(settings, log, entry.row.sha256);
  return entry;
}

EarlierResults::EarlierResults(const BatchFolder& folder)
    : folder_(folder), entries_(read_journal(folder.journal())) {
  for (const auto& [key, entry] : entries_) logs_.insert(entry.row.log);
}

const JournalEntry* EarlierResults::find(const BatchLog& log, const std::vector<FileStamp>& stamps,
                                         const std::string& settings, KnownLogs& known) const {
  if (!logs_.count(valid_utf8(log.name))) return nullptr;
  const KnownLog* before = known.find(valid_utf8(log.name));
  if (before && before->files != stamps) before = nullptr;
  const auto found = entries_.find(result_key(settings, log, before ? before->sha256 : sha256_of_log(log)));
  if (found == entries_.end()) return nullptr;
  const JournalEntry& entry = found->second;
  if (before && before->results == result_stamps(entry, folder_)) {
    known.keep(before->log);
    return &entry;
  }
  if (!is_intact(entry, folder_)) return nullptr;
  note_result(log, stamps, entry, folder_, known);
  return &entry;
}

void note_result(const BatchLog& log, const std::vector<FileStamp>& stamps, const JournalEntry& entry,
                 const BatchFolder& folder, KnownLogs& known) {
  if (!entry.key.empty())
    known.note({valid_utf8(log.name), entry.row.sha256, stamps, result_stamps(entry, folder)});
}

}  // namespace faultline
