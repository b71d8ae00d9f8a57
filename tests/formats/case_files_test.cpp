// SPDX-License-Identifier: MIT
// tests/formats/cases/<case>: a file and what must be read from it, both written by make_cases.py.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "formats/open_log.hpp"
#include "lib/core/error.hpp"
#include "lib/log/log.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::vector<std::string> all_cases() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(std::string(FAULTLINE_SOURCE_DIR) + "/tests/formats/cases"))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

json row_of(const Log& log, int row) {
  json values{{"t", log.time[row]}};
  for_each_joint_channel(
      log, [&](const std::vector<double>& channel, Channel name) { values[to_string(name)] = channel[row]; });
  return values;
}

json issues_of(const LogSource& source) {
  json counts = json::object();
  for (const Issue& issue : source.issues().all())
    counts[issue.code] = counts.value(issue.code, std::int64_t{0}) + issue.count;
  return counts;
}

/// What stands in expected.json, as it was read.
json reading_of(LogSource& source) {
  const Log log = read_all(source);
  return {{"format", source.identity().format},
          {"rows_read", source.identity().rows_read},
          {"rows", log.rows()},
          {"joints", log.joints()},
          {"first", row_of(log, 0)},
          {"last", row_of(log, log.rows() - 1)},
          {"issues", issues_of(source)}};
}

class CaseFile : public testing::TestWithParam<std::string> {};

TEST_P(CaseFile, IsReadWithItsKnownContent) {
  const fs::path folder = fs::path(FAULTLINE_SOURCE_DIR) / "tests/formats/cases" / GetParam();
  fs::path input;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().starts_with("input")) input = entry.path();
  const json expected = json::parse(std::ifstream(folder / "expected.json"));
  try {
    const auto source = open_log(input.string());
    const json first = reading_of(*source);
    EXPECT_EQ(first, expected);
    EXPECT_EQ(source->identity().rows_read,
              first["rows"].get<std::int64_t>() + source->issues().rows_dropped());
    EXPECT_EQ(source->identity().sha256.size(), 64u);
    source->rewind();
    EXPECT_EQ(reading_of(*source), first) << "read a second time";
  } catch (const Error& error) {
    ASSERT_TRUE(expected.contains("error")) << error.what();
    for (const json& part : expected["error"])
      EXPECT_NE(error.message().find(part.get<std::string>()), std::string::npos) << error.message();
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, CaseFile, testing::ValuesIn(all_cases()),
                         [](const testing::TestParamInfo<std::string>& each) { return each.param; });

}  // namespace
}  // namespace faultline
