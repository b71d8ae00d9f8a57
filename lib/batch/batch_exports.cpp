// SPDX-License-Identifier: MIT
#include "lib/batch/batch_exports.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "lib/core/error.hpp"
#include "lib/core/json_values.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/outgoing/json_text.hpp"
#include "lib/core/text.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/report/text.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

std::string junit_body(const BatchRow& row) {
  std::string body;
  for (const FaultEvent& fault : row.faults)
    body += fmt::format("      <failure type=\"{}\" message=\"{}\">onset {}, confidence {:.2f}</failure>\n",
                        to_string(fault.label.kind), escaped_markup(plain_words(fault.label)),
                        seconds_text(fault.onset_s), fault.confidence);
  if (!body.empty()) return body;
  const int status = status_of(row);
  if (status == 0) return "";
  return fmt::format("      <{} message=\"{}\"/>\n", status == 1 ? "skipped" : "error",
                     escaped_markup(row.reason.empty() ? row.verdict : row.reason));
}

Json header(const char* title, const char* description, const char* format = nullptr) {
  Json out{{"title", title}, {"description", description}};
  if (format) out["format"] = format;
  return out;
}

/// Returns the name of a log with " > " between folders: MultiQC keeps of a path its last part, which several
/// logs may have.
std::string sample_name(const BatchRow& row) {
  std::string out;
  for (const char c : row.log) out += c == '/' ? std::string(" > ") : std::string(1, c);
  return out;
}

/// Returns "locked 1, collision 2".
std::string fault_names(const BatchRow& row) {
  std::string out;
  for (const FaultEvent& fault : row.faults) out += (out.empty() ? "" : ", ") + label_text(fault.label);
  return out;
}

Json multiqc_row(const BatchRow& row) {
  Json out{{"verdict", row.verdict}, {"faults", fault_names(row)}};
  if (!row.faults.empty()) out["onset_s"] = row.faults.front().onset_s;
  const auto put = [&](const char* name, double value) {
    if (std::isfinite(value)) out[name] = value;
  };
  put("score", row.score);
  put("residual", residual_level(row));
  out["rows"] = row.rows_used;
  return out;
}

}  // namespace

std::string batch_junit(const std::vector<BatchRow>& rows) {
  std::vector<JunitCase> cases;
  for (const BatchRow& row : rows) cases.push_back({row.log, junit_body(row)});
  return junit_suite("faultline batch", cases, {"errors", "skipped"});
}

std::string batch_multiqc(const std::vector<BatchRow>& rows) {
  Json data = Json::object();
  auto& samples = data.get_ref<Json::object_t&>();  // names differ; the object would compare each with all
  for (const BatchRow& row : rows) samples.push_back({sample_name(row), multiqc_row(row)});
  return json_text(
      Json{{"id", "faultline"},
           {"section_name", "faultline"},
           {"description", "Fault diagnosis of recorded joint logs: a row for each log."},
           {"plot_type", "table"},
           {"pconfig", {{"id", "faultline_table"}, {"title", "faultline: logs"}, {"col1_header", "Log"}}},
           {"headers",
            {{"verdict", header("Verdict", "healthy, faulty, inconclusive, unusable or failed")},
             {"faults", header("Faults", "kind and joint of each fault, by onset")},
             {"onset_s", header("Onset, s", "onset of the first fault, s of the log", "{:,.3f}")},
             {"score", header("Score", "evidence of a fault over its limit; above 1 is an alarm", "{:,.2f}")},
             {"residual", header("Residual", "largest residual of a joint, 1 as in healthy logs", "{:,.2f}")},
             {"rows", header("Rows", "rows that were judged", "{:,.0f}")}}},
           {"data", data}});
}

std::vector<BatchRow> rows_of_batch(const std::string& folder) {
  std::vector<BatchRow> out;
  const std::string path = folder + "/index.ndjson";
  std::ifstream lines(path, std::ios::binary);
  if (!lines) throw Error(ErrorCode::input, path, "cannot be opened; check its permissions");
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) out.push_back(row_from_json(line));
  return out;
}

}  // namespace faultline
