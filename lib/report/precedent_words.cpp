// SPDX-License-Identifier: MIT
#include "lib/report/precedent_words.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lib/core/number_text.hpp"

namespace faultline {
namespace {

bool has(const FaultFinding& fault, CaseOrigin origin) {
  return std::any_of(fault.precedents.begin(), fault.precedents.end(),
                     [origin](const Precedent& p) { return p.origin == origin; });
}

std::string words(const PrecedentFeature& f) {
  return fmt::format("{} (here {}, there {})", f.what, value_text(f.here),
                     feature_value_text(f.there, f.unit));
}

std::string list(const std::vector<PrecedentFeature>& features, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most, features.size()); ++i)
    text += (i == 0 ? "" : ", ") + words(features[i]);
  return text;
}

}  // namespace

std::string precedents_title(const FaultFinding& fault) {
  if (fault.precedents.empty() || has(fault, CaseOrigin::field)) return "Similar cases";
  if (has(fault, CaseOrigin::labelled) || has(fault, CaseOrigin::diagnosed))
    return "Similar cases (none confirmed in the field)";
  return "Similar cases (all simulated, none seen in the field)";
}

std::string feature_value_text(double value, const std::string& unit) {
  return value_text(value) + (unit.empty() ? "" : " " + unit);
}

std::string likeness_words(const Precedent& precedent, std::size_t most) {
  if (precedent.alike.empty() && precedent.unlike.empty()) return "";
  const std::string alike = list(precedent.alike, most), unlike = list(precedent.unlike, most);
  return "alike: " + (alike.empty() ? "no outstanding feature" : alike) + "; unlike: " +
         (unlike.empty() ? "nothing beyond the usual difference of cases of one fault" : unlike);
}

std::string precedent_code(const Precedent& precedent) {
  return fmt::format("{} {} {:.2f}", precedent.case_id, to_string(precedent.origin), precedent.similarity);
}

}  // namespace faultline
