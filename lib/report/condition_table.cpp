// SPDX-License-Identifier: MIT
#include "lib/report/condition_table.hpp"

#include <fmt/format.h>

#include "lib/core/number_text.hpp"

namespace faultline {

FactTable condition_table(const Diagnosis& diagnosis) {
  FactTable table{"Condition: differences from the identified robot, no fault by themselves",
                  {"what", "difference", "95 % interval", "normal within", ""},
                  {}};
  for (const ConditionItem& item : diagnosis.condition)
    if (item.is_determined())
      table.rows.push_back({item.what, condition_value_text(item.value, item.unit),
                            fmt::format("{} to {}", value_text(item.ci95[0]), value_text(item.ci95[1])),
                            fmt::format("{} {}", digits_text(item.normal_range, 2), item.unit),
                            item.is_beyond() ? "beyond" : ""});
  return table;
}

}  // namespace faultline
