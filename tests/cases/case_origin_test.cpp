// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/cases/case.hpp"
#include "lib/core/error.hpp"
#include "tests/cases/example_base.hpp"

namespace faultline {
namespace {

Case field_case() {
  Case c;
  c.decision = c.label = kLocked;
  c.outcome = CaseOutcome::confirmed;
  c.origin = "night.csv";
  c.robot = "bench 7";
  c.person = "A. Weber";
  c.date = "2026-03-02";
  return c;
}

TEST(CaseOrigin, AFieldCaseNamesPersonDateRobotAndLog) {
  EXPECT_EQ(origin_of(field_case()), CaseOrigin::field);
  EXPECT_EQ(origin_words(field_case()),
            "confirmed in the field by A. Weber on 2026-03-02, robot bench 7, log night.csv");
}

TEST(CaseOrigin, MissingFactsAreNamedAsNotRecorded) {
  Case c = field_case();
  c.person = c.date = c.robot = "";
  c.origin = kByHandOrigin;
  EXPECT_EQ(origin_words(c),
            "confirmed in the field, author and date not recorded, recorded by hand without a log");
}

TEST(CaseOrigin, ACorrectedNameIsShownWithTheEarlierName) {
  Case c = field_case();
  c.label = kBias;
  EXPECT_NE(origin_words(c).find("on 2026-03-02 (was called: joint 2 is locked)"), std::string::npos);
  c.outcome = CaseOutcome::rejected;
  EXPECT_EQ(origin_of(c), CaseOrigin::field) << "a person said what it was";
  EXPECT_EQ(origin_words(c).rfind("corrected in the field by A. Weber", 0), 0u);
  c.label = {FaultKind::unknown, Joint()};
  EXPECT_EQ(origin_of(c), CaseOrigin::diagnosed) << "nobody knows what it was";
  EXPECT_EQ(origin_words(c).rfind("rejected in the field by A. Weber", 0), 0u);
}

TEST(CaseOrigin, AnUnconfirmedDiagnosisIsNotAFieldCase) {
  Case c = field_case();
  c.outcome = CaseOutcome::unconfirmed;
  EXPECT_EQ(origin_of(c), CaseOrigin::diagnosed);
  EXPECT_EQ(origin_words(c).rfind("diagnosed, not confirmed", 0), 0u);
}

TEST(CaseOrigin, LabelledAndSimulatedCasesNameTheirOrigin) {
  Case c;
  c.outcome = CaseOutcome::confirmed;
  c.origin = kSimulatedOrigin;
  EXPECT_EQ(origin_words(c, "bench"), "simulated with the robot's model");
  c.robot = "bench 7";
  c.features_by = "another";
  EXPECT_EQ(origin_words(c, "bench"), "simulated with the model of robot bench 7");
  c.origin = kLabelledOrigin;
  c.robot = c.features_by = "";
  c.log_name = "locked_1.csv";
  EXPECT_EQ(origin_of(c), CaseOrigin::labelled);
  EXPECT_EQ(origin_words(c, "bench"), "labelled log locked_1.csv");
}

TEST(CaseOrigin, FeaturesOfAnotherModelAreMentioned) {
  Case c = field_case();
  c.features_by = "another";
  EXPECT_NE(origin_words(c).find("compared by features of another model"), std::string::npos);
}

TEST(CaseOrigin, NamesAreReadBack) {
  for (const auto origin :
       {CaseOrigin::field, CaseOrigin::labelled, CaseOrigin::diagnosed, CaseOrigin::simulated})
    EXPECT_EQ(case_origin_from(to_string(origin)), origin);
  EXPECT_THROW(case_origin_from("heaven"), Error);
}

}  // namespace
}  // namespace faultline
