// SPDX-License-Identifier: MIT
#include "lib/report/csv.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "lib/core/utf8.hpp"

namespace faultline {
namespace {

std::string number(double x) { return std::isfinite(x) ? fmt::format("{}", x) : ""; }

std::string joint(const FaultLabel& label) { return label.joint > 0 ? std::to_string(label.joint) : ""; }

std::string cell(const std::string& text) {
  const std::string valid = valid_utf8(text);
  if (valid.find_first_of(",\"\r\n") == std::string::npos) return valid;
  std::string quoted = "\"";
  for (const char c : valid) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string row(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) line += (i ? "," : "") + cell(cells[i]);
  return line + "\n";
}

std::string alternatives(const FaultFinding& fault) {
  std::string text;
  for (const Alternative& a : fault.could_also_be)
    text += (text.empty() ? "" : ";") + std::string(to_string(a.label.kind)) +
            (a.label.joint > 0 ? " " + std::to_string(a.label.joint) : "");
  return text;
}

std::string fault_row(const Diagnosis& d, const FaultFinding& f) {
  return row({d.log.path, to_string(f.label.kind), joint(f.label), number(f.onset_s), number(f.end_s),
              number(f.alarm_s), number(f.confidence), to_string(f.decided_by), to_string(f.mlp.label.kind),
              joint(f.mlp.label), number(f.mlp.confidence), to_string(f.rbfn.label.kind), joint(f.rbfn.label),
              number(f.rbfn.confidence), alternatives(f), to_string(d.verdict), d.log.sha256,
              d.model.sha256});
}

std::string healthy_row(const Diagnosis& d) {
  return row({d.log.path, "none", "", "", "", "", "", "", "", "", "", "", "", "", "", to_string(d.verdict),
              d.log.sha256, d.model.sha256});
}

}  // namespace

std::string csv_header() {
  return "file,fault,joint,onset_s,end_s,alarm_s,confidence,decided_by,mlp_fault,mlp_joint,mlp_confidence,"
         "rbfn_fault,rbfn_joint,rbfn_confidence,could_also_be,verdict,log_sha256,model_sha256\n";
}

std::string csv_rows(const Diagnosis& diagnosis) {
  if (diagnosis.verdict == Verdict::healthy && diagnosis.faults.empty()) return healthy_row(diagnosis);
  std::string rows;
  for (const FaultFinding& fault : diagnosis.faults) rows += fault_row(diagnosis, fault);
  return rows;
}

std::string render_csv(const Diagnosis& diagnosis) { return csv_header() + csv_rows(diagnosis); }

}  // namespace faultline
