// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <vector>

#include "lib/core/csv_cell.hpp"
#include "lib/fault/fault_kind.hpp"
#include "lib/report/finding_words.hpp"
#include "lib/report/text.hpp"

namespace faultline {
namespace {

std::string csv_row(std::vector<std::string> cells) {
  for (std::string& cell : cells) cell = csv_cell(cell);
  return fmt::format("{}\n", fmt::join(cells, ","));
}

/// Texts of the items in one cell.
template <typename Item, typename Text>
std::string joined(const std::vector<Item>& items, Text text) {
  std::vector<std::string> texts;
  for (const Item& item : items) texts.push_back(text(item));
  return fmt::format("{}", fmt::join(texts, ";"));
}

std::string fault_row(const Diagnosis& d, const FaultFinding& f) {
  return csv_row({d.log.path, to_string(f.label.kind), csv_joint(f.label.joint), csv_cell(f.onset_s),
                  csv_cell(f.end_s), csv_cell(f.alarm_s), csv_cell(f.confidence), to_string(f.decided_by),
                  to_string(f.mlp.label.kind), csv_joint(f.mlp.label.joint), csv_cell(f.mlp.confidence),
                  to_string(f.rbfn.label.kind), csv_joint(f.rbfn.label.joint), csv_cell(f.rbfn.confidence),
                  joined(f.could_also_be, [](const Alternative& a) { return label_text(a.label); }),
                  to_string(d.verdict), d.log.sha256, d.model.sha256, joined(f.precedents, precedent_code)});
}

std::string healthy_row(const Diagnosis& d) {
  return csv_row({d.log.path, "none", "", "", "", "", "", "", "", "", "", "", "", "", "",
                  to_string(d.verdict), d.log.sha256, d.model.sha256, ""});
}

}  // namespace

std::string render_csv(const Diagnosis& diagnosis) {
  std::string text =
      "file,fault,joint,onset_s,end_s,alarm_s,confidence,decided_by,mlp_fault,mlp_joint,mlp_confidence,"
      "rbfn_fault,rbfn_joint,rbfn_confidence,could_also_be,verdict,log_sha256,model_sha256,similar_cases\n";
  if (diagnosis.verdict == Verdict::healthy && diagnosis.faults.empty()) text += healthy_row(diagnosis);
  for (const FaultFinding& fault : diagnosis.faults) text += fault_row(diagnosis, fault);
  return text;
}

}  // namespace faultline
