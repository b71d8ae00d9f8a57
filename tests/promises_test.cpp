// SPDX-License-Identifier: MIT
// docs/promises.md names a test for each promise.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "lib/core/atomic_file.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot(FAULTLINE_SOURCE_DIR);

/// Returns all matches of the first group of a pattern, or of "first.second" of two groups.
std::vector<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> out;
  for (std::sregex_iterator m(text.begin(), text.end(), pattern), end; m != end; ++m)
    out.push_back(m->size() > 2 ? m->str(1) + "." + m->str(2) : m->str(1));
  return out;
}

std::set<std::string> names_of_tests() {
  static const std::regex test(R"(\bTEST(?:_F|_P)?\((\w+), *(\w+)\))");
  std::set<std::string> out;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "tests")) {
    if (entry.path().extension() != ".cpp") continue;
    for (std::string& name : matches(read_file(entry.path()), test)) out.insert(std::move(name));
  }
  return out;
}

/// Whether a filter of GoogleTest, with "*" for any text, selects a test. The instance of a parameterised
/// suite, before "/", is not looked at.
bool selects_a_test(std::string filter, const std::set<std::string>& tests) {
  filter.erase(0, filter.find('/') == std::string::npos ? 0 : filter.find('/') + 1);
  filter =
      std::regex_replace(std::regex_replace(filter, std::regex(R"(\.)"), R"(\.)"), std::regex(R"(\*)"), ".*");
  const std::regex pattern(filter);
  return std::ranges::any_of(tests, [&](const std::string& test) { return std::regex_match(test, pattern); });
}

TEST(Promises, EachNamesTestsOrBenchesThatExist) {
  static const std::regex filter(R"(`((?:\w+/)?[A-Z]\w*(?:\.[\w*]+|\*))`)"),
      bench(R"(`bash (tests/\S+\.sh))");
  const std::string page = read_file(kRoot / "docs/promises.md");
  const std::set<std::string> tests = names_of_tests();
  const std::vector<std::string> filters = matches(page, filter);
  EXPECT_GT(filters.size(), 50u);
  for (const std::string& name : filters) EXPECT_TRUE(selects_a_test(name, tests)) << name;
  for (const std::string& name : matches(page, bench)) EXPECT_TRUE(fs::exists(kRoot / name)) << name;
}

}  // namespace
}  // namespace faultline
