// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/diagnose/fault_event.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/report/text.hpp"

namespace faultline {
namespace {

std::string run_of(const FaultFinding& fault) {
  if (fault.run == 0) return "";
  return fmt::format(" (run {}, {} on its clock)", fault.run,
                     seconds_text(fault.onset_s - fault.clock_offset_s));
}

std::string seconds(double time_s) { return std::isfinite(time_s) ? seconds_text(time_s) : "unknown time"; }

std::string on_clock(const FaultFinding& fault, double time_s) {
  if (fault.run == 0 || !std::isfinite(time_s)) return seconds(time_s);
  return fmt::format("{} ({} on its clock)", seconds_text(time_s),
                     seconds_text(time_s - fault.clock_offset_s));
}

std::string failure(const FaultFinding& fault) {
  return fmt::format(
      "      <failure type=\"{}\" message=\"{}\">onset {}{}, alarm {}, end {}, confidence {:.2f}. "
      "{}</failure>\n",
      to_string(fault.label.kind), escaped_markup(plain_words(fault.label)), seconds(fault.onset_s),
      run_of(fault), on_clock(fault, fault.alarm_s), on_clock(fault, fault.end_s), fault.confidence,
      escaped_markup(fault.next_check));
}

std::vector<JunitCase> test_cases(const Diagnosis& diagnosis) {
  std::vector<JunitCase> cases = {{"robot", ""}};
  for (int j = 0; j < diagnosis.log.joints; ++j) cases.push_back({fmt::format("joint {}", Joint::at(j)), ""});
  for (const FaultFinding& fault : diagnosis.faults) {
    const int place = fault.label.joint.number();  // the case of no joint comes first
    cases[place > 0 && place < std::ssize(cases) ? place : 0].body += failure(fault);
  }
  if (diagnosis.faults.empty() && diagnosis.verdict != Verdict::healthy)
    cases[0].body +=
        fmt::format("      <skipped message=\"{}\"/>\n", escaped_markup(diagnosis.verdict_reason));
  return cases;
}

}  // namespace

std::string junit_suite(const std::string& suite, const std::vector<JunitCase>& cases,
                        const std::vector<std::string>& counts) {
  const auto having = [&](const std::string& element) {
    return std::count_if(cases.begin(), cases.end(),
                         [&](const JunitCase& c) { return c.body.find("<" + element) != std::string::npos; });
  };
  const std::string name = escaped_markup(suite);
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n  <testsuite name=\"{}\" tests=\"{}\" "
      "failures=\"{}\"",
      name, cases.size(), having("failure"));
  for (const std::string& count : counts)
    text += fmt::format(" {}=\"{}\"", count, having(count == "errors" ? "error" : count));
  text += ">\n";
  for (const JunitCase& c : cases)
    text += fmt::format("    <testcase classname=\"{}\" name=\"{}\"{}", name, escaped_markup(c.name),
                        c.body.empty() ? "/>\n" : ">\n" + c.body + "    </testcase>\n");
  return text + "  </testsuite>\n</testsuites>\n";
}

std::string render_junit(const Diagnosis& diagnosis) {
  return junit_suite(diagnosis.log.path, test_cases(diagnosis), {"skipped"});
}

}  // namespace faultline
