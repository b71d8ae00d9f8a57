// SPDX-License-Identifier: MIT
#include "apps/manual/unknown_word.hpp"

#include <gtest/gtest.h>

namespace faultline {
namespace {

const std::vector<std::string> kNames{"diagnose", "learn", "golden", "help"};

TEST(NearestName, ANameWithAMissingExtraWrongOrSwappedLetterIsFound) {
  for (const char* typed : {"diagnos", "diagnosee", "diagnoze", "daignose"})
    EXPECT_EQ(nearest_name(typed, kNames), "diagnose") << typed;
}

TEST(NearestName, TheBeginningOfANameIsFound) { EXPECT_EQ(nearest_name("diag", kNames), "diagnose"); }

TEST(NearestName, AWordFarFromAllNamesHasNoNearestName) {
  EXPECT_EQ(nearest_name("convert", kNames), "");
  EXPECT_EQ(nearest_name("x", kNames), "");
}

}  // namespace
}  // namespace faultline
