// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>

#include "lib/core/atomic_file.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

/// What a shell offers after these words, the last of them begun; with the script loaded.
std::string offered_by_bash(const std::string& script, const std::string& words, int last) {
  const std::string line = "source '" + script + "'; COMP_WORDS=(" + words +
                           "); COMP_CWORD=" + std::to_string(last) + "; _faultline; echo ${COMPREPLY[@]}";
  return run_command({"bash", "-c", line}).out;
}

TEST(Manual, AnErrorOnAnUnknownCommandOrOptionSuggestsTheNearestName) {
  const auto said = [](const std::vector<std::string>& words) {
    const ProgramRun run = run_program(words);
    EXPECT_EQ(run.status, 2);
    return run.err;
  };
  EXPECT_NE(said({"diagnos"}).find("did you mean faultline diagnose?"), std::string::npos);
  EXPECT_NE(said({"--color", "never", "golden", "chek", "g"}).find("faultline golden check?"),
            std::string::npos);
  EXPECT_NE(said({"diagnose", "--jsn", "x", "l"}).find("did you mean --json?"), std::string::npos);
  EXPECT_EQ(said({"cases", "add", "r.json", "--joint", "-1", "--model", "m"}).find("not an option"),
            std::string::npos);
  EXPECT_NE(said({"diagnose", "-dash.csv", "--model", "m"}).find("./-dash.csv"), std::string::npos);
  EXPECT_NE(said({"zzz"}).find("there are inspect, convert"), std::string::npos);
  EXPECT_NE(said({"help", "lern"}).find("did you mean faultline learn?"), std::string::npos);
}

TEST(Manual, AValueOrAFileIsNotTakenForACommand) {
  EXPECT_EQ(run_program({"inspect", "diagnos"}).err.find("did you mean"), std::string::npos);
  EXPECT_EQ(run_program({"learn", "--robot", "chek", "x.csv", "-o", "m"}).err.find("did you mean"),
            std::string::npos);
}

TEST(Manual, HelpOfACommandPrintsTheSameAsItsHelpOption) {
  EXPECT_EQ(run_program({"help", "golden", "check"}).out, run_program({"golden", "check", "--help"}).out);
  EXPECT_EQ(run_program({"help"}).out, run_program({"--help"}).out);
}

TEST(Manual, HelpFitsATerminalOfAHundredColumns) {
  for (const char* command : {"diagnose", "batch", "learn", "inspect", "simulate"}) {
    const std::string help = run_program({"help", command}).out;
    std::size_t begin = 0;
    for (std::size_t end; (end = help.find('\n', begin)) != std::string::npos; begin = end + 1)
      EXPECT_LE(end - begin, 100u) << help.substr(begin, end - begin);
  }
}

TEST(Manual, EveryCommandHasAManPageThatNamesItsOptions) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program({"help", "--man", folder.path().string()}).status, 0);
  for (const char* name :
       {"faultline", "faultline-diagnose", "faultline-golden-check", "faultline-cases-add"})
    EXPECT_TRUE(std::filesystem::exists(folder.file(std::string(name) + ".1"))) << name;
  const std::string page = read_file(folder.file("faultline-diagnose.1"));
  for (const char* text :
       {".SH NAME\nfaultline\\-diagnose \\- Find", ".B \\-\\-json F", ".SH EXAMPLES", "Exit status 0"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
}

TEST(Manual, BashCompletesCommandsOptionsAndFixedValues) {
  const TemporaryFolder folder;
  const std::string script = folder.write("faultline", run_program({"completion", "bash"}).out);
  EXPECT_EQ(offered_by_bash(script, "faultline diag", 1), "diagnose\n");
  EXPECT_EQ(offered_by_bash(script, "faultline golden ch", 2), "check\n");
  EXPECT_EQ(offered_by_bash(script, "faultline diagnose run.csv --js", 3), "--json\n");
  EXPECT_EQ(offered_by_bash(script, "faultline diagnose --classify ''", 3), "evidence samples\n");
  EXPECT_EQ(offered_by_bash(script, "faultline diagnose --classify = e", 4), "evidence\n");
  EXPECT_EQ(offered_by_bash(script, "faultline diagnose --color ''", 3), "auto always never\n");
  EXPECT_EQ(offered_by_bash(script, "faultline completion z", 2), "zsh\n");
  EXPECT_EQ(offered_by_bash(script, "faultline help golden ch", 3), "check\n");
  EXPECT_EQ(offered_by_bash(script, "faultline diagnose --model ''", 3), "\n") << "files are the shell's own";
}

TEST(Manual, CompletionScriptsForZshAndFishParse) {
  for (const std::string shell : {"zsh", "fish"}) {
    const TemporaryFolder folder;
    const ProgramRun script = run_program({"completion", shell});
    ASSERT_EQ(script.status, 0);
    EXPECT_NE(script.out.find("'faultline golden check'"), std::string::npos);
    const std::string path = folder.write("script", script.out);
    if (run_command({"sh", "-c", "command -v " + shell}).status == 0) {
      EXPECT_EQ(run_command({shell, "-n", path}).status, 0) << shell;
    }
  }
}

}  // namespace
}  // namespace faultline
