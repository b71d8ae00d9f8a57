// SPDX-License-Identifier: MIT
#include "apps/work/carried_cases.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "lib/cases/case_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

constexpr const char* kAdvice = "; write to another -o, or move the case base away";

}  // namespace

void check_can_carry_over(const std::string& case_base, int joints) {
  if (::access(case_base.c_str(), W_OK) != 0)
    throw Error(ErrorCode::output, case_base,
                std::string("already exists and cannot be changed: it is read-only") + kAdvice);
  CaseBase there;
  try {
    there = read_case_base(case_base);
  } catch (const Error& error) {
    throw Error(
        ErrorCode::input, case_base,
        "already exists, but its confirmed cases cannot be carried over: it " + error.message() + kAdvice);
  }
  for (const Case& c : there.cases())
    if (!is_made_by_learn(c) && c.label.joint > joints)
      throw Error(ErrorCode::input, case_base,
                  fmt::format("already exists and holds case {} of joint {}, but this robot has {}{}", c.id,
                              c.label.joint, counted(joints, "joint"), kAdvice));
}

std::string carried_text(const std::optional<CarriedCases>& carried) {
  if (!carried) return "";
  std::string text =
      fmt::format("A case base already existed: {} made by learn {} made again, {} carried over",
                  counted(carried->replaced, "case"), carried->replaced == 1 ? "was" : "were",
                  counted(carried->carried, "other"));
  if (carried->recomputed > 0) text += fmt::format(", {} with new features", carried->recomputed);
  if (carried->old_features > 0)
    text += fmt::format(", {} marked and kept with the features of the earlier model", carried->old_features);
  if (carried->renumbered > 0) text += fmt::format(", {} under another number", carried->renumbered);
  return text + ".\n";
}

nlohmann::ordered_json carried_json(const CarriedCases& carried) {
  return {{"carried", carried.carried},
          {"recomputed", carried.recomputed},
          {"old_features", carried.old_features},
          {"renumbered", carried.renumbered},
          {"replaced", carried.replaced}};
}

}  // namespace faultline
