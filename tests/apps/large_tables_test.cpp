// SPDX-License-Identifier: MIT
// Small files that promise much: what inspect takes for them is bounded.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

constexpr long long kMostMemory = 200LL << 20;  // bytes of address space, a little more than what is in use
constexpr double kLongest_s = 5.0;
constexpr double kBusyMachine = 6.0;  // other work runs beside the tests

std::string header(int columns) {
  std::string text = "t,q1";
  for (int i = 2; i < columns; ++i) text += fmt::format(",{:x}", i);
  return text + "\n";
}

std::string row(int columns, const std::string& cell) {
  std::string text;
  for (int i = 0; i < columns; ++i) text += (i ? "," : "") + cell;
  return text + "\n";
}

void expect_bounded(const std::string& name, std::string text) {
  constexpr std::size_t kSize = 1000000;
  if (text.size() > kSize) text.resize(kSize);
  const TemporaryFolder folder;
  const std::string log = folder.write("run.csv", text);
  const auto begin = std::chrono::steady_clock::now();
  const ProgramRun run = run_program({"inspect", log}, {.memory_limit = kMostMemory});
  const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_LE(run.status, 3) << name << ": " << run.err;
  EXPECT_EQ(run.err.find("memory"), std::string::npos) << name << ": " << run.err;
  EXPECT_LT(took, kBusyMachine * kLongest_s) << name;
}

TEST(LargeTables, TakeBoundedMemoryAndTime) {
  const int most = 16384;
  std::string rows_of_one = "t,q1\n";
  for (int i = 0; i < 150000; ++i) rows_of_one += fmt::format("{},1\n", i);
  constexpr int kWide = 1000;
  std::string short_rows = header(kWide);
  for (int i = 0; i < 160; ++i) short_rows += row(kWide, i % 2 ? "x" : "1");
  for (int i = 0; i < 300000; ++i) short_rows += "1\n";
  std::string mixed = header(most);
  for (int i = 0; i < 30; ++i) mixed += row(most, "x") + row(most + 3, "1");
  std::string with_many_rows = header(most);
  for (int i = 0; i < 30; ++i) with_many_rows += fmt::format("{},", i) + row(most - 1, "");
  expect_bounded("164 KB of 32700 columns", header(32700));
  expect_bounded("16384 columns", with_many_rows);
  expect_bounded("commas", std::string(1000000, ','));
  expect_bounded("blanks and letters", [] {
    std::string text;
    for (int i = 0; i < 500000; ++i) text += " a";
    return text;
  }());
  expect_bounded("line breaks", std::string(1000000, '\n'));
  expect_bounded("lines of a comma", [] {
    std::string text;
    for (int i = 0; i < 500000; ++i) text += ",\n";
    return text;
  }());
  expect_bounded("quotes", std::string(1000000, '"'));
  expect_bounded("rows of two", rows_of_one);
  expect_bounded("short rows", short_rows);
  expect_bounded("text cells between long rows", mixed);
}

}  // namespace
}  // namespace faultline
