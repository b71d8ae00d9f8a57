// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/apps/golden_copy.hpp"

namespace faultline {
namespace {

const std::string kRoot = FAULTLINE_SOURCE_DIR;

std::vector<std::string> lines_of(const std::string& path) {
  std::istringstream text(read_file(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

std::string trimmed(const std::string& line, const std::string& lead) {
  const std::size_t begin = line.find_first_not_of(' ');
  return begin == std::string::npos
             ? ""
             : line.substr(begin + (line.compare(begin, lead.size(), lead) ? 0 : lead.size()));
}

/// The commands of the last block of that kind in the file: what checks, after what builds.
std::string check_commands(const std::string& file, const std::string& block, const std::string& lead) {
  std::string commands;
  bool on = false;
  std::size_t indent = 0;
  for (const std::string& line : lines_of(kRoot + "/apps/ci/" + file)) {
    const std::size_t at = line.find_first_not_of(' ');
    if (on && at > indent)
      commands += trimmed(line, lead) + "\n";
    else
      on = false;
    if (line.substr(at) != block) continue;
    commands.clear();
    on = true;
    indent = at;
  }
  return commands;
}

/// As a CI server does: in a checkout that holds the folder `golden` and the program that was built.
int run_in_checkout(const GoldenCopy& golden, const std::string& commands) {
  namespace fs = std::filesystem;
  const fs::path checkout = fs::path(golden.path()).parent_path();
  fs::create_directories(checkout / "faultline/build");
  fs::remove(checkout / "faultline/build/faultline");
  fs::create_symlink(FAULTLINE_PROGRAM, checkout / "faultline/build/faultline");
  write_file((checkout / "commands").string(), commands);
  const std::string line = "cd '" + checkout.string() + "' && bash -e commands >output 2>&1";
  return WEXITSTATUS(std::system(line.c_str()));
}

struct Snippet {
  const char* file;
  const char* block;
  const char* lead;
};

class GoldenCi : public testing::TestWithParam<Snippet> {};

TEST_P(GoldenCi, TheSnippetPassesOnGoldenLogsAndFailsOnADifference) {
  const std::string commands = check_commands(GetParam().file, GetParam().block, GetParam().lead);
  ASSERT_NE(commands.find("golden check"), std::string::npos) << commands;
  const GoldenCopy golden;
  EXPECT_EQ(run_in_checkout(golden, commands), 0) << read_file(golden.outside("output"));
  EXPECT_NE(read_file(golden.outside("golden.xml")).find("tests=\"9\" failures=\"0\""), std::string::npos);
  golden.edit("kind = \"locked\"", "kind = \"collision\"");
  EXPECT_EQ(run_in_checkout(golden, commands), 1);
  EXPECT_NE(read_file(golden.outside("golden.xml")).find("failures=\"1\""), std::string::npos);
}

TEST_P(GoldenCi, ThePageShowsTheSnippetUnchanged) {
  const std::string page = read_file(kRoot + "/docs/golden.md");
  std::string shown;
  std::vector<std::string> lines = lines_of(kRoot + "/apps/ci/" + GetParam().file);
  lines.erase(lines.begin());  // the licence
  for (const std::string& line : lines) shown += "    " + line + "\n";
  EXPECT_NE(page.find(shown), std::string::npos)
      << "docs/golden.md does not show apps/ci/" << GetParam().file;
}

INSTANTIATE_TEST_SUITE_P(Snippets, GoldenCi,
                         testing::Values(Snippet{"golden.github.yml", "run: |", ""},
                                         Snippet{"golden.gitlab.yml", "script:", "- "}),
                         [](const auto& snippet) {
                           return std::string(snippet.index == 0 ? "GitHub" : "GitLab");
                         });

}  // namespace
}  // namespace faultline
