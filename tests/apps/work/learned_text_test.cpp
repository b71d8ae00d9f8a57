// SPDX-License-Identifier: MIT
#include "apps/work/learned_text.hpp"

#include <gtest/gtest.h>

#include "tests/learn/small_robot.hpp"

namespace faultline {
namespace {

TEST(LearnedText, AWarningStatesHowOftenItOccurred) {
  Learned learned = learn_small();
  Issue repeats = make_issue("time_repeated", Severity::warning, "row 2: repeats the time 0 s");
  repeats.count = 482;
  learned.identification.issues.add(repeats);
  learned.identification.issues.add(make_issue("one", Severity::warning, "something else"));
  const std::string text = learned_text(learned, "m.model", "m.cases.db");
  EXPECT_NE(text.find("Warning: row 2: repeats the time 0 s (482 times)\n"), std::string::npos) << text;
  EXPECT_NE(text.find("Warning: something else\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace faultline
