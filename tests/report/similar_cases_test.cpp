// SPDX-License-Identifier: MIT
// How reports speak of similar cases: where each comes from, why it is similar, and no more than is known.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "lib/report/finding_words.hpp"
#include "lib/report/html/html_report.hpp"
#include "lib/report/text.hpp"
#include "tests/report/example_diagnosis.hpp"

namespace faultline {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Lines are broken nowhere.
std::map<std::string, std::string> for_people(const Diagnosis& d) {
  return {
      {"text", render_text(d, {.width = 400})}, {"markdown", render_markdown(d)}, {"html", render_html(d)}};
}

TEST(SimilarCases, EveryReportForPeopleStatesTheirOriginAndWhyTheyAreSimilar) {
  for (const auto& [format, report] : for_people(faulty_diagnosis())) {
    EXPECT_TRUE(has(report, "confirmed in the field by A. Weber on 2026-03-02, robot bench 7")) << format;
    EXPECT_TRUE(has(report, "simulated with the robot")) << format;
    EXPECT_TRUE(has(report, "time from onset until it was named")) << format;
    EXPECT_TRUE(has(report, "13.2")) << format;
    EXPECT_FALSE(has(report, "none seen in the field")) << format;
  }
  EXPECT_TRUE(has(render_html(faulty_diagnosis()), "<summary>Why case 31 is similar"));
}

TEST(SimilarCases, TheHeadlineStatesThatAllAreSimulated) {
  Diagnosis d = faulty_diagnosis();
  d.faults[0].precedents.erase(d.faults[0].precedents.begin());
  for (const auto& [format, report] : for_people(d))
    EXPECT_TRUE(has(report, "Similar cases (all simulated, none seen in the field)")) << format;
  d.faults[0].precedents[0].origin = CaseOrigin::labelled;
  for (const auto& [format, report] : for_people(d))
    EXPECT_TRUE(has(report, "Similar cases (none confirmed in the field)")) << format;
}

TEST(SimilarCases, VotesOfSimulatedCasesAreMarkedAsSimulated) {
  FaultFinding fault = locked_joint();
  fault.decided_by = DecidedBy::cases;
  EXPECT_STREQ(decided_words(fault), "the networks disagree; similar cases decided");
  fault.precedents[0].voted = false;
  EXPECT_STREQ(decided_words(fault), "the networks disagree; similar simulated cases decided");
}

TEST(SimilarCases, ReportsForProgramsHoldTheirOriginAndNumbers) {
  const Diagnosis d = faulty_diagnosis();
  const nlohmann::json shown = nlohmann::json::parse(render_json(d)).at("faults")[0].at("precedents");
  ASSERT_EQ(shown.size(), 2u);
  EXPECT_EQ(shown[0].at("case"), 31);
  EXPECT_EQ(shown[0].at("origin").at("kind"), "field");
  EXPECT_EQ(shown[0].at("origin").at("person"), "A. Weber");
  EXPECT_EQ(shown[0].at("origin").at("date"), "2026-03-02");
  EXPECT_EQ(shown[0].at("unlike")[0].at("there"), 2.25);
  EXPECT_EQ(shown[0].at("unlike")[0].at("unit"), "s");
  EXPECT_EQ(shown[1].at("origin").at("kind"), "simulated");
  EXPECT_TRUE(shown[1].at("origin").at("person").is_null());
  EXPECT_TRUE(has(render_csv(d), "31 field 0.71;12 simulated 0.83"));
}

TEST(SimilarCases, ALackOfUnusualFeaturesIsStated) {
  Precedent p = example_precedents()[1];
  EXPECT_TRUE(has(likeness_words(p, 2), "unlike: nothing beyond the usual difference of cases of one fault"));
  p.alike.clear();
  EXPECT_EQ(likeness_words(p, 2), "");
}

}  // namespace
}  // namespace faultline
