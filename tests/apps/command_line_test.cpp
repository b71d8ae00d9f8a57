// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

TEST(CommandLine, VersionGoesToStandardOutput) {
  const ProgramRun run = run_program({"--version"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.out, "faultline " FAULTLINE_VERSION "\n");
  EXPECT_EQ(run.err, "");
}

TEST(CommandLine, HelpNamesEveryExitStatus) {
  const ProgramRun run = run_program({"--help"});
  EXPECT_EQ(run.status, 0);
  for (const char* word : {"0 nothing wrong", "1 findings", "2 usage", "3 an input", "4 internal"})
    EXPECT_NE(run.out.find(word), std::string::npos) << word;
}

TEST(CommandLine, AMissingSubcommandIsAUsageError) {
  const ProgramRun run = run_program({});
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.out, "");
  EXPECT_NE(run.err.find("--help"), std::string::npos) << run.err;
}

TEST(CommandLine, UnknownOptionIsAUsageErrorThatNamesIt) {
  const ProgramRun run = run_program({"inspect", "--no-such-option", "x.csv"});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("--no-such-option"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("faultline inspect --help"), std::string::npos) << run.err;
}

TEST(CommandLine, UnknownColorIsAUsageError) {
  EXPECT_EQ(run_program({"--color", "pink", "inspect", "x.csv"}).status, 2);
  EXPECT_EQ(run_program({"--color", "1", "inspect", "x.csv"}).status, 2);
}

TEST(CommandLine, StandardOutputThatIsFullIsAFileError) {
  const ProgramRun run = run_program({"--help"}, {.stdout_path = "/dev/full"});
  EXPECT_EQ(run.status, 3);
  EXPECT_NE(run.err.find("standard output"), std::string::npos) << run.err;
}

TEST(CommandLine, HelpIntoAClosedPipeEndsBySigpipe) {
  const ProgramRun run = run_command(
      {"bash", "-c",
       std::string("{ sleep 0.3; ") + FAULTLINE_PROGRAM + " --help; echo status $? >&2; } | true"});
  EXPECT_EQ(run.err, "status 141\n");  // 128 and SIGPIPE
}

TEST(CommandLine, AReportIntoAClosedPipeKeepsItsExitStatus) {
  const std::string golden = std::string(FAULTLINE_SOURCE_DIR) + "/sample_logs/golden";
  for (const char* format : {"--md", "--json", "--csv"}) {
    const ProgramRun run =
        run_command({"bash", "-c",
                     "{ sleep 0.3; " + std::string(FAULTLINE_PROGRAM) + " diagnose " + golden +
                         "/logs/healthy_quintic.csv --model " + golden + "/model-*.json --cases " + golden +
                         "/cases-* " + format + " -; echo status $? >&2; } | true"});
    EXPECT_NE(run.err.find("status 0"), std::string::npos) << format << ": " << run.err;
    EXPECT_EQ(run.err.find("cannot be written"), std::string::npos) << format << ": " << run.err;
  }
}

TEST(CommandLine, InspectHelpShowsAnExample) {
  const ProgramRun run = run_program({"inspect", "--help"});
  EXPECT_EQ(run.status, 0);
  EXPECT_NE(run.out.find("Example"), std::string::npos) << run.out;
}

TEST(CommandLine, EachCommandOffersTheModesAndCriteriaOfTheLibrary) {
  for (const std::string command : {"diagnose", "batch"}) {
    const std::string help = run_program({command, "--help"}).out;
    EXPECT_NE(help.find("--classify TEXT:{evidence,samples}"), std::string::npos) << help;
    EXPECT_NE(help.find("--criterion TEXT:{log_odds,consecutive}"), std::string::npos) << help;
    const ProgramRun run = run_program({command, "run.csv", "--model", "m", "-o", "o", "--classify", "both"});
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find("{evidence,samples}"), std::string::npos) << run.err;
  }
}

}  // namespace
}  // namespace faultline
