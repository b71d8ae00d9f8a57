// SPDX-License-Identifier: MIT
#include "lib/diagnose/diagnose_options.hpp"

#include <gtest/gtest.h>

#include <string>

namespace faultline {
namespace {

TEST(DiagnoseOptions, TheFirstOfEachChoiceIsTheDefault) {
  EXPECT_EQ(kClassifyModes.front(), DiagnoseOptions{}.mode);
  EXPECT_EQ(kCriterionKinds.front(), DiagnoseOptions{}.criterion);
}

TEST(DiagnoseOptions, ChoicesHaveTheNamesOfTheCommandLine) {
  EXPECT_EQ(to_string(ClassifyMode::evidence), std::string("evidence"));
  EXPECT_EQ(to_string(ClassifyMode::samples), std::string("samples"));
  EXPECT_EQ(to_string(CriterionKind::log_odds), std::string("log_odds"));
  EXPECT_EQ(to_string(CriterionKind::consecutive), std::string("consecutive"));
}

}  // namespace
}  // namespace faultline
