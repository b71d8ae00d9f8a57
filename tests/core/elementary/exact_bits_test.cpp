// SPDX-License-Identifier: MIT
// The bits that every machine has to give: another processor, compiler or C library fails here.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <vector>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/random.hpp"

namespace faultline::elementary {
namespace {

constexpr int kArguments = 20000;

std::uint64_t mixed(std::uint64_t hash, double value) {
  hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3u;
  return hash ^ hash >> 29;
}

TEST(ElementaryBits, ValuesAtManyArgumentsHaveTheRecordedHash) {
  struct Case {
    const char* name;
    double (*function)(double);
    double low, high;
    std::uint64_t hash;
  };
  for (const Case& c : std::vector<Case>{{"exp", exp, -2.0, 2.0, 0xa23a0ba6b896c1f1},
                                         {"exp", exp, -745.0, 709.0, 0x4c56b2fc756af839},
                                         {"log", log, 0.0, 3.0, 0x9bb2cd3b83ae9b5b},
                                         {"log", log, 0.0, 1e9, 0x121c9086cc875e2e},
                                         {"log10", log10, 0.0, 1e3, 0x2905d729e37c92e2},
                                         {"log1p", log1p, -0.9, 9.0, 0x23cc6be602970cea},
                                         {"sin", sin, -4.0, 4.0, 0xbfbe42394c0584c2},
                                         {"sin", sin, -1e5, 1e5, 0x0fe9488aa6937a1b},
                                         {"sin", sin, -1e12, 1e12, 0xa8eda35ece5cbc3a},
                                         {"cos", cos, -4.0, 4.0, 0x602ed0962d3cbc45},
                                         {"cos", cos, -1e12, 1e12, 0x327e80c4821136f8},
                                         {"tanh", tanh, -3.0, 3.0, 0x4aa29f5d472d6bb0},
                                         {"asinh", asinh, -9.0, 9.0, 0x2e8a2d73b3182377},
                                         {"atan", atan, -9.0, 9.0, 0x7a2bd0dc0aaebbec},
                                         {"erfc", erfc, -3.0, 9.0, 0x5c312f03ffea1639}}) {
    Random random(11);
    std::uint64_t hash = 0;
    for (int i = 0; i < kArguments; ++i)
      hash = mixed(hash, c.function(c.low + (c.high - c.low) * random.uniform()));
    EXPECT_EQ(hash, c.hash) << c.name << " from " << c.low << " to " << c.high;
  }
}

TEST(ElementaryBits, ValuesAtManyPairsHaveTheRecordedHash) {
  struct Case {
    const char* name;
    double (*function)(double, double);
    double low, high;
    std::uint64_t hash;
  };
  for (const Case& c : std::vector<Case>{{"pow", pow, 0.0, 9.0, 0x58d8316a6958a4e0},
                                         {"atan2", atan2, -3.0, 3.0, 0x4213f6e7a4259386},
                                         {"hypot", hypot, -3.0, 3.0, 0xb68ae2341842a050}}) {
    Random random(11);
    std::uint64_t hash = 0;
    for (int i = 0; i < kArguments; ++i) {
      const double x = c.low + (c.high - c.low) * random.uniform();
      const double y = c.low + (c.high - c.low) * random.uniform();
      hash = mixed(hash, c.function(x, y));
    }
    EXPECT_EQ(hash, c.hash) << c.name;
  }
}

TEST(ElementaryBits, ValuesAtSingleArgumentsHaveTheRecordedBits) {
  EXPECT_EQ(exp(0.7), 0x1.01c2a61268987p+1);
  EXPECT_EQ(exp(-13.37), 0x1.a31ad57ba12f4p-20);
  EXPECT_EQ(exp(0.001), 0x1.0041919b7ee34p+0);
  EXPECT_EQ(log(0.3), -0x1.34378fcbda721p+0);
  EXPECT_EQ(log(1.0009765), 0x1.ffb7a9452f0b3p-11);
  EXPECT_EQ(log(12345.678), 0x1.2d79559791e31p+3);
  EXPECT_EQ(log10(0.02), -0x1.b2efb2bd8218p+0);
  EXPECT_EQ(log1p(0.0123), 0x1.90967a5c9c8ap-7);
  EXPECT_EQ(sin(0.5), 0x1.eaee8744b05fp-2);
  EXPECT_EQ(sin(2.0), 0x1.d18f6ead1b446p-1);
  EXPECT_EQ(sin(-31.4), 0x1.04ede8c1cb30cp-6);
  EXPECT_EQ(cos(0.78), 0x1.6bfcdbf817bfap-1);
  EXPECT_EQ(cos(2.5), -0x1.9a2f7ef858b7dp-1);
  EXPECT_EQ(cos(1000.0), 0x1.1ff026793f1bbp-1);
  EXPECT_EQ(tanh(0.3), 0x1.2a4dda7d914fap-2);
  EXPECT_EQ(tanh(0.56), 0x1.04159e3ace145p-1);
  EXPECT_EQ(tanh(2.2), 0x1.f3949a819042dp-1);
  EXPECT_EQ(asinh(0.7), 0x1.4e2a4fe9085ddp-1);
  EXPECT_EQ(atan(0.4), 0x1.85a376b677dcp-2);
  EXPECT_EQ(erfc(0.4), 0x1.24a9c1da6fafdp-1);
  EXPECT_EQ(erfc(3.1), 0x1.86dd3472492c4p-17);
  EXPECT_EQ(pow(1.1, 37.5), 0x1.1d4f239d9008ep+5);
  EXPECT_EQ(pow(0.01, 0.2), 0x1.97a967f7524b3p-2);
  EXPECT_EQ(atan2(-0.3, 0.7), -0x1.9e9bf3d20dc71p-2);
  EXPECT_EQ(hypot(0.3, 0.7), 0x1.85ed7614b038cp-1);
}

}  // namespace
}  // namespace faultline::elementary
