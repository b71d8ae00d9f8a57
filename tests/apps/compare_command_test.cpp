// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/batch/batch_world.hpp"

namespace faultline {
namespace {

using Json = nlohmann::json;

TEST(CompareCommand, ExitStatusDistinguishesEqualFromDifferentRuns) {
  const TemporaryFolder folder;
  const std::string a = write_motion(folder, "a.csv", 1, false), b = write_motion(folder, "b.csv", 2, false),
                    bad = write_motion(folder, "bad.csv", 3, true);
  const ProgramRun same = run_program({"compare", a, b});
  EXPECT_EQ(same.status, 0) << same.out << same.err;
  EXPECT_NE(same.out.find("The runs are the same within noise."), std::string::npos);
  const std::string page = folder.file("page.html");
  const ProgramRun other = run_program({"compare", a, bad, "--html", page, "--json", "-"});
  EXPECT_EQ(other.status, 1) << other.err;
  const Json json = Json::parse(other.out);
  EXPECT_EQ(json["schema"], "faultline/comparison/1");
  EXPECT_EQ(json["same"], false);
  EXPECT_NEAR(json["diverges_s"].get<double>(), 2.0, 0.1);
  EXPECT_NE(read_file(page).find("The runs differ from"), std::string::npos);
  const std::string junit = run_program({"compare", a, bad, "--junit", "-"}).out;
  EXPECT_NE(junit.find("<testcase classname=\"" + bad + "\" name=\"position of joint 1\">"),
            std::string::npos)
      << junit;
  EXPECT_NE(junit.find("<failure type=\"position\" message=\"position of joint 1 differs from"),
            std::string::npos);
  EXPECT_NE(run_program({"compare", a, b, "--junit", "-"}).out.find("failures=\"0\""), std::string::npos);
  const ProgramRun again = run_program({"compare", a, bad, "--html", "-"});
  EXPECT_EQ(again.out, read_file(page));
}

TEST(CompareCommand, ShowsTheResidualsOfBothRunsWithAModel) {
  const BatchWorld world;
  const TemporaryFolder folder;
  const std::string a = write_motion(folder, "a.csv", 1, false),
                    bad = write_motion(folder, "bad.csv", 3, true);
  const ProgramRun run = run_program(
      {"compare", a, bad, "--model", world.model(), "--json", "-", "--html", folder.file("page.html")});
  EXPECT_EQ(run.status, 1) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json["signals"].back()["quantity"], "residual");
  EXPECT_GT(std::abs(json["signals"].back()["largest"].get<double>()), 10.0);
  EXPECT_EQ(json["signals"][0]["unit"], "m") << "the model knows that the joint slides";
  EXPECT_NE(read_file(folder.file("page.html")).find("Residual of joint 1"), std::string::npos);
}

TEST(CompareCommand, ResidualsOfHealthyRunsOfDifferentMotionsAreTheSame) {
  const BatchWorld world;
  world.add_log("a.csv", 8.0, false, 11);
  world.add_log("b.csv", 8.0, false, 12);
  world.add_log("bad.csv", 8.0, true, 13);
  const auto verdict = [&](const std::string& second) {
    return std::string(
        Json::parse(run_program({"compare", world.logs() + "/a.csv", world.logs() + "/" + second, "--model",
                                 world.model(), "--json", "-"})
                        .out)["verdict"]);
  };
  EXPECT_EQ(verdict("b.csv"), "The runs are different motions; their residuals are the same within noise.");
  EXPECT_NE(verdict("bad.csv").find("their residuals differ from 4."), std::string::npos)
      << verdict("bad.csv");
}

TEST(CompareCommand, RunsThatCannotBeComparedAndWrongOptionsAreRefused) {
  const TemporaryFolder folder;
  const std::string a = write_motion(folder, "a.csv", 1, false);
  EXPECT_EQ(run_program({"compare", a, folder.file("none.csv")}).status, 3);
  EXPECT_EQ(run_program({"compare", a, folder.write("words.csv", "one,two\nthree,four\n")}).status, 3);
  EXPECT_EQ(run_program({"compare", a}).status, 2);
  EXPECT_EQ(run_program({"compare", a, a, "--align", "space"}).status, 2);
  const ProgramRun over = run_program({"compare", a, a, "--json", a});
  EXPECT_EQ(over.status, 2);
  EXPECT_NE(over.err.find("would overwrite"), std::string::npos) << over.err;
}

}  // namespace
}  // namespace faultline
