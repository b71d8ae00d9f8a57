// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/error.hpp"
#include "lib/golden/observation.hpp"

namespace faultline {
namespace {

TEST(GoldenTraceFile, IsReadBackWithNanAndExactTimes) {
  const Trace trace{{"q1", "dq1"}, {0.1 + 0.2, 1763710000.073}, {{1.0 / 3.0, NAN}, {-1e-12, 2.0}}};
  const Trace read = trace_from_csv(trace_to_csv(trace), "a.csv");
  EXPECT_EQ(read.channels, trace.channels);
  EXPECT_EQ(read.time, trace.time);
  EXPECT_NEAR(read.values[0][0], 1.0 / 3.0, 1e-9);
  EXPECT_TRUE(std::isnan(read.values[0][1]));
  EXPECT_EQ(read.values[1], trace.values[1]);
}

TEST(GoldenTraceFile, DamageIsNamedWithItsLine) {
  for (const char* text : {"", "q1\n1\n", "t,q1\n0.1,1\n0.2\n", "t,q1\n0.1,x\n", "t,q1\n0.1,1,2\n"}) {
    try {
      trace_from_csv(text, "a.csv");
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::input);
      EXPECT_NE(error.where().find("a.csv, line "), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace faultline
