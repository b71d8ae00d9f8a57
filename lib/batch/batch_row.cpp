// SPDX-License-Identifier: MIT
#include "lib/batch/batch_row.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/distributions.hpp"
#include "lib/core/text.hpp"
#include "lib/core/utf8.hpp"

namespace faultline {
namespace {

int issues_of(const Diagnosis& diagnosis, Severity severity) {
  const auto& all = diagnosis.log.issues.all();
  return static_cast<int>(
      std::count_if(all.begin(), all.end(), [&](const Issue& issue) { return issue.severity == severity; }));
}

/// "row 17, column tau2" of "/data/run.csv, row 17, column tau2".
std::string place_inside(const std::string& where, const std::string& path) {
  if (!where.starts_with(path)) return where;
  const std::size_t begin = where.find_first_not_of(", :", path.size());
  return begin == std::string::npos ? "" : where.substr(begin);
}

}  // namespace

BatchRow row_of(const Diagnosis& d) {
  BatchRow row;
  row.log = valid_utf8(d.log.path);
  row.sha256 = d.log.sha256;
  row.model = valid_utf8(d.model.name);
  row.model_sha256 = d.model.sha256;
  row.verdict = to_string(d.verdict);
  row.reason = valid_utf8(d.verdict_reason);
  if (!d.model.grave_doubts.empty()) row.doubt = valid_utf8(d.model.grave_doubts.front());
  row.format = d.log.format;
  row.rows = d.log.rows_read;
  row.rows_used = d.log.rows_used;
  row.start_s = d.log.start_s;
  row.end_s = d.log.end_s;
  row.sample_period_s = d.log.sample_period_s;
  row.joints = d.log.joints;
  row.warnings = issues_of(d, Severity::warning);
  row.severe = issues_of(d, Severity::severe);
  for (const JointResidual& residual : d.residuals) {
    row.residual_rms.push_back(residual.velocity_rms);
    row.residual_peak.push_back(residual.velocity_peak);
  }
  row.faults = events_of(d.faults);
  for (const ConditionItem& item : d.condition)
    if (item.is_determined())
      row.condition.push_back({item.name, item.value, (item.ci95[1] - item.value) / kNormal95, item.unit});
  return row;
}

BatchRow unusable_row(const std::string& name, const std::string& path, const Error& error,
                      const ModelFacts& model) {
  BatchRow row;
  row.log = valid_utf8(name);
  row.model = valid_utf8(model.name);
  row.model_sha256 = model.sha256;
  row.verdict = error.code() == ErrorCode::internal ? "failed" : "unusable";
  const std::string place = place_inside(error.where(), path);
  row.reason = brief(place.empty() ? error.message() : place + ": " + error.message());
  return row;
}

double residual_level(const BatchRow& row) {
  double level = std::numeric_limits<double>::quiet_NaN();
  for (const double rms : row.residual_rms)
    if (!(level >= rms) && !std::isnan(rms)) level = rms;
  return level;
}

std::string folder_of(const BatchRow& row) {
  const std::size_t end = row.log.rfind('/');
  return end == std::string::npos ? "" : row.log.substr(0, end);
}

int status_of(const BatchRow& row) {
  if (row.verdict == "failed") return 4;
  if (row.verdict == "unusable") return 3;
  return row.faults.empty() && row.verdict != "inconclusive" ? 0 : 1;
}

}  // namespace faultline
