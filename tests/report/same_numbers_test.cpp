// SPDX-License-Identifier: MIT
// All reports are renderings of one Diagnosis: none of them may show another number than the others.
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "lib/core/number_text.hpp"
#include "lib/report/finding_words.hpp"
#include "lib/report/html/html_report.hpp"
#include "lib/report/text.hpp"
#include "tests/report/example_details.hpp"

namespace faultline {
namespace {

/// A diagnosis whose numbers occur nowhere else.
Diagnosis odd_numbers() {
  Diagnosis d = faulty_diagnosis();
  FaultFinding& f = d.faults[0];
  f.onset_s = 3.1411;
  f.alarm_s = 3.2718;
  f.end_s = 8.1618;
  f.confidence = 0.734;
  f.mlp.confidence = 0.817;
  f.rbfn.confidence = 0.653;
  f.precedents[0].similarity = 0.577;
  f.evidence[0].value = 264.5;
  d.residuals[1].velocity_rms = 13.7;
  d.residuals[1].velocity_peak = 46.9;
  return d;
}

std::map<std::string, std::string> for_people(const Diagnosis& d) {
  return {{"text", std::regex_replace(render_text(d), std::regex("\\s+"), " ")},  // lines are wrapped
          {"HTML", render_html(d)},
          {"HTML with plots", render_html(d, example_details(d))},
          {"Markdown", render_markdown(d)}};
}

TEST(SameNumbers, AreInEveryReportForPeople) {
  const Diagnosis d = odd_numbers();
  for (const auto& [format, report] : for_people(d)) {
    for (const char* number :
         {"3.141 s", "3.272 s", "8.162 s", "73 %", "0.82", "0.65", "0.58", "13.7", "46.9"})
      EXPECT_NE(report.find(number), std::string::npos) << number << " is not in " << format;
    EXPECT_NE(report.find(value_text(264.5)), std::string::npos) << format;
    EXPECT_NE(report.find("1 fault: joint 2 is locked, from 3.141 s."), std::string::npos) << format;
    EXPECT_NE(report.find("both networks agree"), std::string::npos) << format;
    EXPECT_NE(report.find("changed the brake relay"), std::string::npos) << format;
  }
}

TEST(SameNumbers, AreInEveryReportForPrograms) {
  const Diagnosis d = odd_numbers();
  const nlohmann::json fault = nlohmann::json::parse(render_json(d)).at("faults").at(0);
  const std::string csv = render_csv(d), junit = render_junit(d);
  const std::map<std::string, double> numbers = {{"onset_s", 3.1411}, {"alarm_s", 3.2718}, {"end_s", 8.1618}};
  for (const auto& [key, value] : numbers) {
    EXPECT_EQ(fault.at(key).get<double>(), value);
    EXPECT_NE(csv.find("," + fault.at(key).dump() + ","), std::string::npos) << key;
    EXPECT_NE(junit.find(time_text(value, d.log.sample_period_s)), std::string::npos) << key;
  }
  EXPECT_EQ(fault.at("confidence").get<double>(), 0.734);
  EXPECT_NE(csv.find(",0.734,"), std::string::npos);
  EXPECT_NE(junit.find("confidence 0.73"), std::string::npos);
  EXPECT_EQ(fault.at("opinions").at("mlp").at("confidence").get<double>(), 0.817);
  EXPECT_NE(csv.find(",0.817,"), std::string::npos);
}

TEST(SameNumbers, AChangeOfTheDiagnosisReachesEveryReport) {
  Diagnosis other = odd_numbers();
  other.faults[0].onset_s = 2.2222;
  const auto before = for_people(odd_numbers()), after = for_people(other);
  for (const auto& [format, report] : after) {
    EXPECT_EQ(report.find("3.141 s"), std::string::npos) << format;
    EXPECT_NE(report, before.at(format)) << format;
  }
  for (const auto& render : {render_json, render_csv, render_junit})
    EXPECT_EQ(render(other).find("3.141"), std::string::npos);
}

TEST(MarkdownReport, MarkupInForeignTextIsEscaped) {
  Diagnosis d = faulty_diagnosis();
  d.log.path = "<b>|x|</b> @you #12 **a** [b](http://c.d) www.e.f `g` ~~h~~ \n# i";
  const std::string text = render_markdown(d);
  for (const char* markup :
       {"<b>", "|x|", "@you", " #12", "**a**", "[b](", "http://", "www.e", "`g`", "~~h", "\n# i"})
    EXPECT_EQ(text.find(markup), std::string::npos) << markup;
}

TEST(MarkdownReport, EveryRowOfATableHasTheCellsOfItsHead) {
  std::size_t bars = 0, rows = 0;
  std::istringstream lines(render_markdown(hostile_diagnosis()));
  for (std::string line; std::getline(lines, line);) {
    std::size_t here = 0;
    for (std::size_t i = 0; i < line.size(); ++i) here += line[i] == '|' && (i == 0 || line[i - 1] != '\\');
    if (here > 0 && bars > 0) {
      EXPECT_EQ(here, bars) << line;
    }
    rows += here > 0;
    bars = here;
  }
  EXPECT_GT(rows, 15u);
}

}  // namespace
}  // namespace faultline
