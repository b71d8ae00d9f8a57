// SPDX-License-Identifier: MIT
#include "apps/service/report_facts.hpp"

#include <nlohmann/json.hpp>

namespace faultline {
namespace {

/// The number of a member that may be null.
template <typename Number>
Number number_or_zero(const nlohmann::json& json) {
  return json.is_null() ? Number{} : json.get<Number>();
}

ReportedFault reported_fault(const nlohmann::json& fault) {
  ReportedFault out;
  out.id = fault.at("id");
  out.label = {fault_kind_from(fault.at("kind").get<std::string>()),
               Joint::numbered(number_or_zero<int>(fault.at("joint")))};
  out.onset_s = fault.at("onset_s");
  out.confidence = fault.at("confidence");
  out.next_check = fault.at("next_check");
  return out;
}

}  // namespace

ReportFacts report_facts(const std::string& json) {
  const auto report = nlohmann::json::parse(json);
  ReportFacts facts;
  facts.verdict = report.at("verdict");
  facts.verdict_reason = report.at("verdict_reason");
  facts.sample_period_s = number_or_zero<double>(report.at("log").at("sample_period_s"));
  facts.joints = report.at("log").at("joints");
  for (const auto& fault : report.at("faults")) facts.faults.push_back(reported_fault(fault));
  return facts;
}

}  // namespace faultline
