// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <array>
#include <tuple>

#include "apps/cases/case_actions.hpp"
#include "apps/python/bindings.hpp"
#include "lib/core/error.hpp"

namespace faultline {
namespace {

namespace py = pybind11;

struct NamedAction {
  const char* name;
  CasesAnswer (*action)(const CasesArguments&);
};
constexpr std::array<NamedAction, 8> kActions{{{"list", list_cases},
                                               {"show", show_case},
                                               {"add", add_case},
                                               {"confirm", confirm_case},
                                               {"reject", reject_case},
                                               {"delete", delete_case},
                                               {"export", export_cases},
                                               {"import", import_cases}}};

template <typename Value>
void take(const py::dict& given, const char* name, Value& value) {
  if (given.contains(name)) value = given[name].cast<Value>();
}

CasesArguments arguments_from(const py::dict& given) {
  CasesArguments arguments;
  take(given, "model", arguments.model);
  take(given, "cases", arguments.cases);
  take(given, "id", arguments.id);
  take(given, "fault", arguments.fault);
  take(given, "joint", arguments.joint_number);
  take(given, "outcome", arguments.outcome);
  take(given, "origin", arguments.origin);
  take(given, "done", arguments.done);
  take(given, "by", arguments.by);
  take(given, "date", arguments.date);
  take(given, "robot", arguments.robot);
  take(given, "diagnosis", arguments.diagnosis);
  take(given, "diagnosis_text", arguments.diagnosis_text);
  take(given, "fault_id", arguments.fault_id);
  take(given, "file", arguments.file);
  take(given, "replace", arguments.replace);
  take(given, "merge", arguments.merge);
  take(given, "confirmed", arguments.confirmed);
  return arguments;
}

/// Returns the result as JSON, as text, and an unexpected effect.
std::tuple<std::string, std::string, std::string> act(const std::string& name, const py::dict& given) {
  const CasesArguments arguments = arguments_from(given);
  const py::gil_scoped_release others_run;
  for (const NamedAction& one : kActions) {
    if (name != one.name) continue;
    const CasesAnswer answer = one.action(arguments);
    return {answer.json.dump(2) + "\n", answer.text, answer.note};
  }
  throw Error(ErrorCode::internal, name, "is not an action of cases");
}

}  // namespace

void bind_cases(py::module_& module) {
  module.def("cases", &act, py::arg("action"), py::arg("arguments"), "Reads or revises a case base.");
}

}  // namespace faultline
