// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>

#include "lib/report/html/html_report.hpp"
#include "lib/report/text.hpp"
#include "tests/report/example_diagnosis.hpp"

namespace faultline {
namespace {

/// Half of joint 1's torque is lost.
Diagnosis lost_torque() {
  Diagnosis d = faulty_diagnosis();
  d.faults[0].label = {FaultKind::torque_loss, 1_joint};
  d.faults[0].evidence.push_back({.name = "size", .unit = {}, .text = "about 50 % of the torque is lost"});
  return d;
}

TEST(VerdictSentence, StatesTheSizeOfTheFault) {
  const std::string sentence =
      "1 fault: joint 1 lost a part of its torque, from 4.210 s, about 50 % of the torque is lost.";
  EXPECT_EQ(verdict_sentence(lost_torque()), sentence);
  EXPECT_NE(render_text(lost_torque()).find(sentence), std::string::npos);
  EXPECT_NE(render_html(lost_torque()).find(sentence + "</p>"), std::string::npos);
}

TEST(VerdictSentence, NamesTheMostCertainFaultFirstHoweverLateItBegan) {
  Diagnosis d = lost_torque();
  d.faults[0].confidence = 0.57;
  d.faults.push_back(locked_joint());
  d.faults.back().onset_s = 8.0;
  d.faults.back().confidence = 0.95;
  EXPECT_EQ(
      verdict_sentence(d),
      "2 faults, the most certain first: joint 2 is locked, from 8.000 s (confidence 95 %); joint 1 lost "
      "a part of its torque, from 4.210 s, about 50 % of the torque is lost (confidence 57 %).");
}

TEST(VerdictSentence, CountsTheFaultsThatItDoesNotName) {
  Diagnosis d = faulty_diagnosis();
  for (int i = 0; i < 4; ++i) d.faults.push_back(locked_joint());
  EXPECT_TRUE(verdict_sentence(d).starts_with("5 faults, the most certain first: "));
  EXPECT_TRUE(verdict_sentence(d).ends_with("; and 2 more."));
}

TEST(VerdictSentence, OmitsASizeThatWasNotEstimated) {
  EXPECT_EQ(verdict_sentence(faulty_diagnosis()), "1 fault: joint 2 is locked, from 4.210 s.");
  EXPECT_EQ(render_html(faulty_diagnosis()).find("Size: "), std::string::npos);
}

TEST(VerdictSentence, TheHeadOfAFindingStatesItsSize) {
  EXPECT_NE(render_html(lost_torque()).find("<p class=\"size\">Size: about 50 % of the torque is lost.</p>"),
            std::string::npos);
}

}  // namespace
}  // namespace faultline
