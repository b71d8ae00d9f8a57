// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/core/json_values.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/outgoing/json_text.hpp"
#include "lib/core/text.hpp"
#include "lib/golden/new_run.hpp"
#include "lib/report/text.hpp"

namespace faultline {
namespace {

using RunsJson = nlohmann::ordered_json;

constexpr const char* kNoSuchMotion =
    "no healthy run of the folder has this motion; record one with faultline golden record";

std::string leaving_words(const SignalCheck& signal) {
  return fmt::format(
      "{} of joint {} leaves its tolerance at {}: largest difference {} {} at {}, tolerance {} {}",
      signal.quantity, signal.joint, seconds_text(signal.leaves_s), value_text(signal.largest), signal.unit,
      seconds_text(signal.largest_s), value_text(signal.tolerance), signal.unit);
}

std::string basis_words(const NewRunCheck& run) {
  if (run.recorded == 2)
    return fmt::format(
        "nearest {} of 2 recorded runs of this motion, which hardly show how runs differ; record more",
        printable(run.nearest));
  if (run.recorded > 2)
    return fmt::format("nearest {} of {} recorded runs of this motion", printable(run.nearest), run.recorded);
  return fmt::format(
      "{} is the only recorded run of this motion, so the tolerance is its noise alone; record more of them",
      printable(run.nearest));
}

RunsJson check_json(const SignalCheck& signal) {
  RunsJson json{{"quantity", signal.quantity},
                {"joint", signal.joint.number()},
                {"unit", signal.unit},
                {"judged", signal.judged},
                {"largest", number_or_null(signal.largest)},
                {"largest_s", number_or_null(signal.largest_s)},
                {"tolerance", number_or_null(signal.tolerance)},
                {"leaves_s", number_or_null(signal.leaves_s)}};
  if (!signal.reason.empty()) json["wider_because"] = signal.reason;
  return json;
}

RunsJson run_result_json(const NewRunCheck& run) {
  return {{"log", run.log},
          {"same", run.same()},
          {"nearest", text_or_null(run.nearest)},
          {"recorded_runs", run.recorded},
          {"shift_s", number_or_null(run.alignment.shift_s)},
          {"signals", list_of<RunsJson>(run.signals, check_json)}};
}

std::string case_body(const SignalCheck& signal) {
  if (!signal.judged)
    return "      <skipped message=\"is not judged: it must differ between these runs\"/>\n";
  if (std::isnan(signal.leaves_s)) return "";
  return fmt::format("      <failure type=\"{}\" message=\"{}\"/>\n", escaped_markup(signal.quantity),
                     escaped_markup(leaving_words(signal)));
}

}  // namespace

std::string to_text(const std::vector<NewRunCheck>& runs) {
  std::string text;
  int differ = 0;
  for (const NewRunCheck& run : runs) {
    differ += !run.same();
    if (run.nearest.empty()) {
      text += fmt::format("{}: {}\n", printable(run.log), kNoSuchMotion);
      continue;
    }
    text += fmt::format("{}: {} ({})\n", printable(run.log), run.same() ? "as recorded" : "differs",
                        basis_words(run));
    for (const SignalCheck& signal : run.signals) {
      if (!std::isnan(signal.leaves_s)) text += "  " + leaving_words(signal) + "\n";
      if (!signal.reason.empty())
        text += fmt::format("  wider tolerance of the {} of joint {}: {}\n", signal.quantity, signal.joint,
                            printable(signal.reason));
    }
  }
  return text +
         fmt::format("{} of {} as recorded.\n", std::ssize(runs) - differ, counted(std::ssize(runs), "run"));
}

std::string new_runs_json(const std::vector<NewRunCheck>& runs) {
  const bool same = std::all_of(runs.begin(), runs.end(), [](const NewRunCheck& run) { return run.same(); });
  return json_text({{"schema", "faultline/golden-runs/1"},
                    {"same", same},
                    {"runs", list_of<RunsJson>(runs, run_result_json)}});
}

std::string new_runs_junit(const std::vector<NewRunCheck>& runs) {
  std::vector<JunitCase> cases;
  for (const NewRunCheck& run : runs) {
    std::string motion;
    if (run.nearest.empty())
      motion =
          fmt::format("      <failure type=\"motion\" message=\"{}\"/>\n", escaped_markup(kNoSuchMotion));
    cases.push_back({run.log + ": motion", motion});
    for (const SignalCheck& signal : run.signals)
      cases.push_back(
          {fmt::format("{}: {} of joint {}", run.log, signal.quantity, signal.joint), case_body(signal)});
  }
  return junit_suite("golden runs", cases, {"skipped"});
}

}  // namespace faultline
