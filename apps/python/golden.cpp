// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <nlohmann/json.hpp>

#include "apps/python/bindings.hpp"
#include "apps/python/watched_work.hpp"
#include "apps/work/golden_work.hpp"
#include "lib/core/error.hpp"
#include "lib/core/outgoing/json_text.hpp"
#include "lib/golden/check.hpp"

namespace faultline {
namespace {

namespace py = pybind11;

using Json = nlohmann::ordered_json;

std::string recorded_json(const Recorded& recorded, const std::vector<std::string>& skipped) {
  Json json{{"logs", Json::array()}};
  for (const GoldenLog& log : recorded.set.logs)
    json["logs"].push_back(
        {{"name", log.name()}, {"verdict", log.expected.verdict}, {"events", log.expected.events.size()}});
  json["identified"] = recorded.set.identification.has_value();
  json["no_identification"] = recorded.no_identification;
  json["skipped"] = skipped;
  return json_text(json);
}

std::string record_logs(const std::vector<std::string>& logs, const std::string& model,
                        const std::string& cases, const std::string& folder, bool identify, int trace_points,
                        int threads, const py::object& progress) {
  RecordArguments arguments{{{model, cases}, folder, "", "", 0}, logs, {identify, trace_points, threads}};
  return watched(progress, [&](ProgressRelay& watch) {
    const std::vector<std::string> skipped = skip_label_tables(arguments.logs);
    return recorded_json(record_folder(arguments, watch.progress()), skipped);
  });
}

/// The result as JSON and as text.
using Checked = std::pair<std::string, std::string>;

Checked check(const std::string& folder, const std::string& model, const std::string& cases,
              const std::string& junit, int threads, const py::object& progress) {
  const GoldenArguments arguments{{model, cases}, folder, "", junit, threads};
  return watched(progress, [&](ProgressRelay& watch) {
    const CheckedFolder checked = check_folder(arguments, watch.progress());
    return Checked(render_check_json(checked.check, checked.run), render_check_text(checked.check));
  });
}

/// Returns the accepted names and those not accepted.
std::pair<std::vector<std::string>, std::vector<std::string>> accept(
    const std::string& folder, const std::vector<std::string>& names, bool all, bool same_verdict,
    const std::string& model, const std::string& cases, int threads, const py::object& progress) {
  const AcceptArguments arguments{{{model, cases}, folder, "", "", threads}, names, all, same_verdict};
  if (!arguments.accepts() || (!names.empty() + all + same_verdict) > 1)
    throw Error(ErrorCode::usage, "accept", "needs exactly one of names, all=True and same_verdict=True");
  return watched(progress, [&](ProgressRelay& watch) {
    const AcceptPlan plan = plan_accept(arguments, watch.progress());
    if (plan.is_refused(arguments)) return std::pair(std::vector<std::string>{}, plan.otherwise);
    carry_out(plan, arguments);
    return std::pair(plan.names, plan.otherwise);
  });
}

}  // namespace

void bind_golden(py::module_& module) {
  module.def("golden_record", &record_logs, py::arg("logs"), py::arg("model"), py::arg("cases"),
             py::arg("folder"), py::arg("identify"), py::arg("trace_points"), py::arg("threads"),
             py::arg("progress"), "Makes a golden folder.");
  module.def("golden_check", &check, py::arg("folder"), py::arg("model"), py::arg("cases"), py::arg("junit"),
             py::arg("threads"), py::arg("progress"), "Replays a golden folder and compares.");
  module.def("golden_accept", &accept, py::arg("folder"), py::arg("names"), py::arg("all"),
             py::arg("same_verdict"), py::arg("model"), py::arg("cases"), py::arg("threads"),
             py::arg("progress"), "Makes different results the expected ones.");
}

}  // namespace faultline
