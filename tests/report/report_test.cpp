// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>
#include <sstream>
#include <utility>

#include "lib/diagnose/curves/run_curves.hpp"
#include "lib/report/finding_words.hpp"
#include "lib/report/html/html_report.hpp"
#include "lib/report/text.hpp"
#include "tests/report/example_details.hpp"

namespace faultline {
namespace {

using Json = nlohmann::ordered_json;

Diagnosis empty_diagnosis() { return {}; }

const std::vector<Diagnosis (*)()> kExamples = {healthy_diagnosis, faulty_diagnosis, hostile_diagnosis,
                                                inconclusive_diagnosis, empty_diagnosis};

TEST(SmallChanges, AChangeTooSmallToBeReportedAsAFaultIsInTextMarkdownHtmlAndJson) {
  Diagnosis d = healthy_diagnosis();
  FaultFinding gram;
  gram.label = {FaultKind::payload_change, 3_joint};
  gram.onset_s = 4.2;
  gram.confidence = 0.98;
  gram.extent = {0.0014, 0.06, "kg", 0.0014 / 0.06};
  d.small_changes = {gram};
  for (const std::string& report : {render_text(d), render_markdown(d), render_html(d)}) {
    EXPECT_NE(report.find(kSmallChangesTitle), std::string::npos);
    EXPECT_NE(report.find("0.0014"), std::string::npos);
    EXPECT_NE(report.find("0.06"), std::string::npos);
  }
  const Json json = Json::parse(render_json(d));
  EXPECT_EQ(json.at("verdict"), "healthy");
  EXPECT_EQ(json.at("small_changes").at(0).at("kind"), "payload_change");
  EXPECT_EQ(json.at("small_changes").at(0).at("size").at("least"), 0.06);
}

TEST(JsonReport, ParsesAndHasEveryKeyOfTheContract) {
  for (const auto example : kExamples) {
    const Json json = Json::parse(render_json(example()));
    EXPECT_EQ(json.at("schema"), "faultline/diagnosis/1");
    for (const char* key :
         {"path", "sha256", "format", "rows", "start_s", "end_s", "sample_period_s", "issues"})
      EXPECT_TRUE(json.at("log").contains(key)) << key;
    for (const char* key : {"name", "sha256", "cases_sha256"})
      EXPECT_TRUE(json.at("model").contains(key)) << key;
    EXPECT_TRUE(json.at("program").contains("version"));
    for (const Json& fault : json.at("faults"))
      for (const char* key : {"id", "kind", "joint", "onset_s", "alarm_s", "end_s", "confidence", "opinions",
                              "decided_by", "precedents", "could_also_be", "evidence", "next_check"})
        EXPECT_TRUE(fault.contains(key)) << key;
  }
}

TEST(JsonReport, FaultsAreNumberedByOnset) {
  const Json faults = Json::parse(render_json(hostile_diagnosis())).at("faults");
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[0].at("id"), 1);
  EXPECT_EQ(faults[0].at("kind"), "unknown");
  EXPECT_LT(faults[0].at("onset_s").get<double>(), faults[1].at("onset_s").get<double>());
}

TEST(JsonReport, MissingNumbersAreNullAndValuesAreExact) {
  Diagnosis d = faulty_diagnosis();
  d.faults[0].onset_s = 0.1 + 0.2;
  d.faults[0].end_s = std::numeric_limits<double>::quiet_NaN();
  d.faults[0].confidence = std::numeric_limits<double>::infinity();
  const Json fault = Json::parse(render_json(d)).at("faults")[0];
  EXPECT_EQ(fault.at("onset_s").get<double>(), 0.1 + 0.2);
  EXPECT_TRUE(fault.at("end_s").is_null());
  EXPECT_TRUE(fault.at("confidence").is_null());
  EXPECT_EQ(render_json(d).find("nan"), std::string::npos);
}

TEST(JsonReport, TheSameDiagnosisGivesTheSameBytes) {
  EXPECT_EQ(render_json(hostile_diagnosis()), render_json(hostile_diagnosis()));
}

/// Cells of RFC 4180 text, by record.
std::vector<std::vector<std::string>> parse_csv(const std::string& text) {
  std::vector<std::vector<std::string>> records(1, {""});
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (quoted && text[i] == '"' && i + 1 < text.size() && text[i + 1] == '"')
      records.back().back() += text[i++];
    else if (text[i] == '"')
      quoted = !quoted;
    else if (text[i] == ',' && !quoted)
      records.back().emplace_back();
    else if (text[i] == '\n' && !quoted)
      records.push_back({""});
    else
      records.back().back() += text[i];
  }
  records.pop_back();
  return records;
}

TEST(CsvReport, EveryRecordHasTheColumnsOfTheHeader) {
  for (const auto example : kExamples) {
    const auto records = parse_csv(render_csv(example()));
    ASSERT_GE(records.size(), 1u);
    EXPECT_EQ(records[0].size(), 19u);
    for (const auto& record : records) EXPECT_EQ(record.size(), records[0].size());
  }
}

TEST(CsvReport, HasOneRowPerFaultAndOneForAHealthyLog) {
  EXPECT_EQ(parse_csv(render_csv(hostile_diagnosis())).size(), 3u);
  EXPECT_EQ(parse_csv(render_csv(inconclusive_diagnosis())).size(), 1u);
  const auto healthy = parse_csv(render_csv(healthy_diagnosis()));
  ASSERT_EQ(healthy.size(), 2u);
  EXPECT_EQ(healthy[1][1], "none");
}

TEST(CsvReport, HostileNamesAreReadBack) {
  const Diagnosis d = hostile_diagnosis();
  const std::string path = parse_csv(render_csv(d))[1][0];
  EXPECT_EQ(path.substr(0, 6), d.log.path.substr(0, 6));
  EXPECT_NE(path.find('\n'), std::string::npos);
}

TEST(JunitReport, EscapesAndCountsFailures) {
  const std::string xml = render_junit(hostile_diagnosis());
  EXPECT_NE(xml.find("failures=\"2\""), std::string::npos);
  EXPECT_EQ(xml.find('\x1b'), std::string::npos);
  EXPECT_EQ(xml.find("<c>"), std::string::npos);
  EXPECT_NE(render_junit(inconclusive_diagnosis()).find("skipped=\"1\""), std::string::npos);
  EXPECT_NE(render_junit(healthy_diagnosis()).find("tests=\"4\" failures=\"0\" skipped=\"0\""),
            std::string::npos);
}

TEST(JunitReport, OpenedElementsAreClosed) {
  for (const auto example : kExamples) {
    const std::string xml = render_junit(example());
    const auto count = [&](const std::string& pattern) {
      const std::regex regex(pattern);
      return std::distance(std::sregex_iterator(xml.begin(), xml.end(), regex), std::sregex_iterator());
    };
    EXPECT_EQ(count("<testcase[^>]*[^/]>"), count("</testcase>"));
    EXPECT_EQ(count("<failure"), count("</failure>"));
  }
}

TEST(HtmlReport, EscapesEveryTextAndLoadsNothing) {
  const std::string html = render_html(hostile_diagnosis());
  EXPECT_EQ(html.find("<c>"), std::string::npos);
  EXPECT_EQ(html.find('\x1b'), std::string::npos);
  EXPECT_EQ(html.find("]]> \"done\""), std::string::npos);
  for (const char* loads : {"src=", "href=\"http", "<script", "@import", "url("})
    EXPECT_EQ(html.find(loads), std::string::npos) << loads;
}

/// As much as a page ever shows: noise, so that nothing compresses, for `joints` joints and 12 faults.
std::size_t largest_page(int joints) {
  Diagnosis d = traced_diagnosis();
  d.log.end_s = 3600.0;
  d.faults.clear();
  ReportDetails details = example_details(d);
  auto window = [&](int fault, double start_s, double end_s, int bins) {
    CurveWindow w = example_window(fault, start_s, end_s, bins, joints);
    std::minstd_rand random(1);
    for (JointCurves& joint : w.joints)
      for (Envelope* e :
           {&joint.q, &joint.q_predicted, &joint.dq, &joint.dq_predicted, &joint.tau, &joint.tau_required})
        for (float& value : e->values) value = static_cast<float>(random() % 10000);
    return w;
  };
  const RunCurvesOptions options;
  details.curves.whole = window(0, 0.0, 3600.0, options.whole_bins);
  for (int i = 0; i < options.most_details; ++i) {
    d.faults.push_back(traced_diagnosis().faults[0]);
    d.faults.back().onset_s = 200.0 * i;
    const int bins = 4 * options.all_details / (joints * options.most_details);
    details.curves.details.push_back(window(i + 1, 200.0 * i - 1.0, 200.0 * i + 3.0, bins));
  }
  d.faults = numbered_by_onset(std::move(d.faults));
  return render_html(d, details).size();
}

TEST(HtmlReport, StaysSmallForALongLog) {
  EXPECT_LT(largest_page(4), 3'000'000u);
  EXPECT_LT(largest_page(8), 5'000'000u);
}

TEST(HtmlReport, AxesCountFromTheStartOfAClockThatRunsSince1970) {
  Diagnosis d = faulty_diagnosis();
  for (double* time :
       {&d.log.start_s, &d.log.end_s, &d.faults[0].onset_s, &d.faults[0].alarm_s, &d.faults[0].end_s})
    *time += 1.7e9;
  const std::string html = render_html(d, example_details(d));
  EXPECT_NE(html.find("Axes of time count from 1700000000 s."), std::string::npos);
  EXPECT_NE(html.find(">1700000004.210 s<"), std::string::npos) << "in the table";
  EXPECT_EQ(html.find("1.7e+09"), std::string::npos);
  EXPECT_NE(render_text(d).find(" s after 1700000000 s\n"), std::string::npos);
}

TEST(HtmlReport, OpenedElementsAreClosed) {
  for (const auto example : kExamples) {
    std::string html = render_html(example());
    html.erase(html.find("<style>"), html.find("</style>") - html.find("<style>"));
    const auto count = [&](const std::string& pattern) {
      const std::regex regex(pattern);
      return std::distance(std::sregex_iterator(html.begin(), html.end(), regex), std::sregex_iterator());
    };
    for (const std::string element :
         {"table", "tr", "td", "th", "ul", "li", "section", "svg", "p", "h2", "h3", "title"})
      EXPECT_EQ(count("<" + element + "[ >]"), count("</" + element + ">")) << element;
  }
}

TEST(TextReport, HoldsNoControlCharacterButLineBreaks) {
  const std::string text = render_text(hostile_diagnosis());
  for (const char c : text) EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20);
}

TEST(TextReport, AsciiOutputHoldsOnlyAscii) {
  const std::string text = render_text(faulty_diagnosis(), {.unicode = false});
  EXPECT_TRUE(
      std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; }));
}

TEST(TextReport, ColorAddsOnlyColorCodes) {
  const std::string colored = render_text(faulty_diagnosis(), {.color = true});
  const std::string plain = std::regex_replace(colored, std::regex("\x1b\\[[0-9;]*m"), "");
  EXPECT_EQ(plain, render_text(faulty_diagnosis()));
  EXPECT_NE(colored, plain);
}

TEST(Timeline, MarksAreAtTheirTimes) {
  Diagnosis d = faulty_diagnosis();
  d.log.start_s = 0.0;
  d.log.end_s = 100.0;
  d.faults[0].onset_s = 50.0;
  d.faults[0].alarm_s = 75.0;
  d.faults[0].end_s = 100.0;
  std::istringstream lines(render_timeline(d, {.width = 112, .unicode = false}));
  std::string joint1, joint2;
  std::getline(lines, joint1);
  std::getline(lines, joint2);
  ASSERT_EQ(joint2.size(), 110u);
  EXPECT_EQ(joint2.substr(0, 10), "  joint 2 ");
  EXPECT_EQ(joint2[10 + 50], '1');
  EXPECT_EQ(joint2[10 + 75], '!');
  EXPECT_EQ(joint2[10 + 49], '-');
  EXPECT_EQ(joint2[10 + 60], '+');
  EXPECT_EQ(joint2[10 + 99], '#');
  EXPECT_EQ(joint1.find_first_of("1!+#", 10), std::string::npos);
}

TEST(Timeline, TimesOutsideTheLogStayInside) {
  Diagnosis d = faulty_diagnosis();
  d.faults[0].onset_s = -1e300;
  d.faults[0].alarm_s = 1e300;
  EXPECT_FALSE(render_timeline(d).empty());
  d.log.end_s = d.log.start_s;
  EXPECT_TRUE(render_timeline(d).empty());
}

}  // namespace
}  // namespace faultline
