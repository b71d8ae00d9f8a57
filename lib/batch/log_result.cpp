// SPDX-License-Identifier: MIT
#include "lib/batch/log_result.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "lib/core/atomic_file.hpp"
#include "lib/core/hash.hpp"
#include "lib/html/html_report.hpp"
#include "lib/html/report_details.hpp"
#include "lib/identify/identify.hpp"
#include "lib/report/json.hpp"

namespace faultline {
namespace {

constexpr std::size_t kReadable = 100;  // characters of a log's name in the name of its result
constexpr std::size_t kHash = 12;

std::string joined(const std::string& a, const std::string& b) {
  return std::to_string(a.size()) + " " + a + "\n" + b + "\n";
}

std::string render_page(LogSource& log, const Model& model, const Diagnosis& diagnosis,
                        const DiagnoseOptions& options) {
  return render_html(diagnosis, report_details(log, model, diagnosis, options));
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

void refuse_changed(const BatchLog& log, const LogSource& source, const std::string& log_sha256) {
  if (source.identity().sha256 != log_sha256)
    throw Error(ErrorCode::input, log.path, "changed while it was read; run again when it is complete");
}

bool is_file_with(const std::string& path, const std::string& sha256) {
  std::error_code error;
  return sha256.empty() || (std::filesystem::is_regular_file(path, error) && sha256_of_file(path) == sha256);
}

}  // namespace

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

bool is_intact(const JournalEntry& entry, const BatchFolder& folder) {
  const std::string stem = folder.file("logs/" + entry.row.result);
  return is_file_with(stem + ".json", entry.json_sha) && is_file_with(stem + ".html", entry.html_sha);
}

JournalEntry write_log_result(const BatchLog& log, const std::string& log_sha256, const OpenLog& open,
                              const Model& model, const CaseBase& cases, const BatchFolder& folder,
                              const BatchOptions& options) {
  const auto source = open(log.path);
  Diagnosis diagnosis = diagnose(*source, model, cases, options.diagnose);
  diagnosis.log.path = log.name;
  refuse_changed(log, *source, log_sha256);
  JournalEntry entry;
  entry.row = row_of(diagnosis);
  if (options.identify && diagnosis.verdict == Verdict::healthy)
    entry.row.parameters = parameters_in(*source, model.robot);
  entry.row.result = result_name(log.name, log_sha256);
  const std::string stem = folder.file("logs/" + entry.row.result);
  if (options.html) {
    const std::string page = render_page(*source, model, diagnosis, options.diagnose);
    refuse_changed(log, *source, log_sha256);
    write_file(stem + ".html", page);
    entry.html_sha = sha256_hex(page);
  }
  const std::string json = render_json(diagnosis);
  write_file(stem + ".json", json);
  entry.json_sha = sha256_hex(json);
  return entry;
}

}  // namespace faultline
