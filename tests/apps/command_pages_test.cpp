// SPDX-License-Identifier: MIT
// What the pages say of the program: each command's --help (FAULTLINE_APPROVE=1 writes it into them), the
// names of issues, and the example in C++.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

#include "lib/core/atomic_file.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

const fs::path kPages = fs::path(FAULTLINE_SOURCE_DIR) / "docs/reference";
const std::string kFence = "```", kBegin = kFence + "text\n$ faultline ";

std::vector<std::string> words_of(const std::string& command) {
  std::istringstream text(command);
  std::vector<std::string> words;
  for (std::string word; text >> word;) words.push_back(word);
  return words;
}

/// The page with what the program says now in place of each block "$ faultline COMMAND --help".
std::string page_of_today(const std::string& page, std::set<std::string>& commands) {
  std::string today;
  std::size_t at = 0;
  for (std::size_t begin; (begin = page.find(kBegin, at)) != std::string::npos;) {
    const std::size_t words = begin + kBegin.size(), end_of_line = page.find('\n', words);
    const std::string command = page.substr(words, end_of_line - words);
    commands.insert(command);
    today += page.substr(at, end_of_line + 1 - at) + run_program(words_of(command)).out;
    at = page.find("\n" + kFence, end_of_line) + 1;
  }
  return today + page.substr(at);
}

/// Commands that a text of --help lists under "Commands:".
std::vector<std::string> subcommands_in(const std::string& help) {
  static const std::regex entry("\n  ([a-z]+)  +[A-Z]");
  const std::size_t begin = help.find("\nCommands:");
  if (begin == std::string::npos) return {};
  const std::string list = help.substr(begin, help.find("\n\n", begin) - begin);
  std::vector<std::string> names;
  for (std::sregex_iterator it(list.begin(), list.end(), entry), end; it != end; ++it)
    names.push_back((*it)[1].str());
  return names;
}

TEST(DocumentationCommands, EachPageShowsTheOutputOfHelp) {
  const bool approve = std::getenv("FAULTLINE_APPROVE") != nullptr;
  std::vector<fs::path> pages = {kPages / "commands.md"};
  for (const auto& entry : fs::directory_iterator(kPages / "commands")) pages.push_back(entry.path());
  EXPECT_GE(pages.size(), 12u);
  for (const fs::path& path : pages) {
    std::set<std::string> commands;
    const std::string page = read_file(path.string()), today = page_of_today(page, commands);
    EXPECT_FALSE(commands.empty()) << path;
    EXPECT_EQ(page, today) << path << "; FAULTLINE_APPROVE=1 mends it";
    if (approve && page != today) write_file(path.string(), today);
  }
}

TEST(DocumentationCommands, EachCommandHasAPageAndEachSubcommandABlock) {
  const auto names = subcommands_in(run_program({"--help"}).out);
  EXPECT_GE(names.size(), 11u);
  const std::string overview = read_file((kPages / "commands.md").string());
  for (const std::string& name : names) {
    const fs::path path = kPages / "commands" / (name + ".md");
    ASSERT_TRUE(fs::exists(path)) << path;
    EXPECT_NE(overview.find("(commands/" + name + ".md)"), std::string::npos) << name;
    const std::string page = read_file(path.string());
    for (const std::string& own : subcommands_in(run_program({name, "--help"}).out))
      EXPECT_NE(page.find("$ faultline " + name + " " + own + " --help"), std::string::npos)
          << name << " " << own;
  }
}

/// The block of code of that language in a page.
std::string code_in(const std::string& page, const std::string& language) {
  const std::string mark = "\n" + kFence + language + "\n";
  const std::size_t begin = page.find(mark);
  if (begin == std::string::npos) return "";
  const std::size_t code = begin + mark.size();
  return page.substr(code, page.find("\n" + kFence, code) + 1 - code);
}

TEST(DocumentationCpp, TheExampleProgramCompilesAndPrintsItsUsage) {
  const TemporaryFolder folder;
  const std::string code = code_in(read_file((kPages / "cpp.md").string()), "cpp"),
                    log = folder.file("log.txt"), built = folder.file("night_check");
  ASSERT_NE(code.find("faultline::diagnose("), std::string::npos);
  fs::create_directory_symlink(FAULTLINE_SOURCE_DIR, folder.file("faultline"));  // as it is installed
  // Without the libraries: what it does before it calls them can be seen, and takes seconds.
  const std::string command = "c++ -std=c++20 -static -Wl,--unresolved-symbols=ignore-all -I'" +
                              std::string(FAULTLINE_SOURCE_DIR) + "' -I'" + folder.path().string() +
                              "' -isystem /usr/include/eigen3 '" + folder.write("main.cpp", code) + "' -o '" +
                              built + "' >'" + log + "' 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0) << read_file(log);
  const int status = std::system(("'" + built + "' robot.toml 2>'" + log + "'").c_str());
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 2) << status;
  EXPECT_EQ(read_file(log), "usage: " + built + " ROBOT.toml BAD HEALTHY...\n");
}

std::string sources() {
  std::string text;
  for (const char* folder : {"lib", "apps", "formats"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(FAULTLINE_SOURCE_DIR) / folder))
      if (entry.path().extension() == ".cpp" || entry.path().extension() == ".hpp")
        text += read_file(entry.path().string());
  return text;
}

TEST(DocumentationTroubleshooting, EveryIssueCodeOfThePageOccursInTheSources) {
  static const std::regex code("`([a-z]+(_[a-z]+)+)`");
  const std::string program = sources();
  std::istringstream page(read_file(std::string(FAULTLINE_SOURCE_DIR) + "/docs/how-to/troubleshooting.md"));
  int checked = 0;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("| `", 0) != 0) continue;
    const std::string symptom = line.substr(0, line.find(" | "));
    for (std::sregex_iterator it(symptom.begin(), symptom.end(), code), end; it != end; ++it, ++checked)
      EXPECT_NE(program.find("\"" + (*it)[1].str() + "\""), std::string::npos) << (*it)[1];
  }
  EXPECT_GT(checked, 15);
}

}  // namespace
}  // namespace faultline
