// SPDX-License-Identifier: MIT
#include "lib/report/csv.hpp"

#include <vector>

#include "lib/core/csv_cell.hpp"
#include "lib/fault/label_text.hpp"
#include "lib/report/precedent_words.hpp"

namespace faultline {
namespace {

std::string csv_row(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) line += (i ? "," : "") + csv_cell(cells[i]);
  return line + "\n";
}

std::string alternatives(const FaultFinding& fault) {
  std::string text;
  for (const Alternative& a : fault.could_also_be) text += (text.empty() ? "" : ";") + label_text(a.label);
  return text;
}

std::string similar_cases_cell(const FaultFinding& fault) {
  std::string text;
  for (const Precedent& p : fault.precedents) text += (text.empty() ? "" : ";") + precedent_code(p);
  return text;
}

std::string fault_row(const Diagnosis& d, const FaultFinding& f) {
  return csv_row({d.log.path, to_string(f.label.kind), csv_joint(f.label.joint), csv_cell(f.onset_s),
                  csv_cell(f.end_s), csv_cell(f.alarm_s), csv_cell(f.confidence), to_string(f.decided_by),
                  to_string(f.mlp.label.kind), csv_joint(f.mlp.label.joint), csv_cell(f.mlp.confidence),
                  to_string(f.rbfn.label.kind), csv_joint(f.rbfn.label.joint), csv_cell(f.rbfn.confidence),
                  alternatives(f), to_string(d.verdict), d.log.sha256, d.model.sha256,
                  similar_cases_cell(f)});
}

std::string healthy_row(const Diagnosis& d) {
  return csv_row({d.log.path, "none", "", "", "", "", "", "", "", "", "", "", "", "", "",
                  to_string(d.verdict), d.log.sha256, d.model.sha256, ""});
}

}  // namespace

std::string csv_header() {
  return "file,fault,joint,onset_s,end_s,alarm_s,confidence,decided_by,mlp_fault,mlp_joint,mlp_confidence,"
         "rbfn_fault,rbfn_joint,rbfn_confidence,could_also_be,verdict,log_sha256,model_sha256,"
         "similar_cases\n";
}

std::string csv_rows(const Diagnosis& diagnosis) {
  if (diagnosis.verdict == Verdict::healthy && diagnosis.faults.empty()) return healthy_row(diagnosis);
  std::string rows;
  for (const FaultFinding& fault : diagnosis.faults) rows += fault_row(diagnosis, fault);
  return rows;
}

std::string render_csv(const Diagnosis& diagnosis) { return csv_header() + csv_rows(diagnosis); }

}  // namespace faultline
