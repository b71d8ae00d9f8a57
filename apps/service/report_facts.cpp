// SPDX-License-Identifier: MIT
#include "apps/service/report_facts.hpp"

#include <nlohmann/json.hpp>

#include "lib/core/json_values.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

ReportedFault reported_fault(const Json& fault) {
  ReportedFault out;
  out.id = fault.at("id");
  out.label = {fault_kind_from(fault.at("kind").get<std::string>()),
               Joint::numbered(count_or_zero(fault.at("joint")))};
  out.onset_s = fault.at("onset_s");
  out.confidence = fault.at("confidence");
  out.next_check = fault.at("next_check");
  return out;
}

}  // namespace

ReportFacts report_facts(const std::string& json) {
  const Json report = Json::parse(json);
  ReportFacts facts;
  facts.verdict = report.at("verdict");
  facts.verdict_reason = report.at("verdict_reason");
  const double period_s = number_or_nan(report.at("log").at("sample_period_s"));
  if (period_s > 0.0) facts.sample_period_s = period_s;
  facts.joints = report.at("log").at("joints");
  for (const Json& fault : report.at("faults")) facts.faults.push_back(reported_fault(fault));
  return facts;
}

}  // namespace faultline
