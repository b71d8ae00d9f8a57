// SPDX-License-Identifier: MIT
// A folder of golden logs that came from somebody else, made to show or overwrite files elsewhere, or never
// to end.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "lib/cases/case_file.hpp"
#include "lib/core/hash.hpp"
#include "tests/apps/golden_copy.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

class ForeignGoldenFolder : public testing::Test {
 protected:
  ForeignGoldenFolder() { write_file(secret(), "root:x:0:0:a secret line\n"); }

  std::string secret() const { return golden_.outside("secret"); }

  /// By every command that reads the folder: a sentence that names the file, status 3, nothing shown or
  /// changed.
  void expect_refused(const std::string& file, const std::string& word) const {
    const std::string json = golden_.outside("check.json");
    for (const std::vector<std::string>& command : {std::vector<std::string>{"check", "--json", json},
                                                    {"accept", "--all"},
                                                    {"compare", golden_.file("", "model-")}}) {
      const ProgramRun run = golden_.run(command[0], {command.begin() + 1, command.end()});
      EXPECT_EQ(run.status, 3) << command[0] << " " << file << run.out;
      EXPECT_EQ(run.out, "") << command[0];
      EXPECT_NE(run.err.find(file), std::string::npos) << run.err;
      EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
      EXPECT_EQ(run.err.find("secret line"), std::string::npos) << run.err;
    }
    EXPECT_FALSE(fs::exists(json));
    EXPECT_EQ(read_file(secret()), "root:x:0:0:a secret line\n");
  }

  /// Puts a link or a pipe in the place of a file, and the file back afterwards.
  void expect_not_opened(const std::string& file) const {
    const fs::path path = fs::path(golden_.path()) / file, kept = golden_.outside("kept");
    fs::rename(path, kept);
    for (const std::string& target : {secret(), std::string("/dev/zero"), kept.string()}) {
      fs::create_symlink(target, path);
      expect_refused(file, "symbolic link");
      fs::remove(path);
    }
    ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
    expect_refused(file, "pipe");
    fs::remove(path);
    fs::rename(kept, path);
  }

  std::string named(const std::string& folder, const std::string& beginning) const {
    return fs::relative(golden_.file(folder, beginning), golden_.path()).string();
  }

  GoldenCopy golden_;
};

TEST_F(ForeignGoldenFolder, LinksAndPipesInPlaceOfItsFilesAreNotOpened) {
  for (const std::string& file : {std::string("golden.toml"), named("logs", "locked_1"),
                                  named("traces", "locked_1"), named("", "model-"), named("", "cases-")})
    expect_not_opened(file);
  EXPECT_EQ(golden_.run("check").status, 0) << "the folder is as it was";
}

TEST_F(ForeignGoldenFolder, ALinkInPlaceOfADatabaseJournalIsNotOpened) {
  const std::string journal = named("", "cases-") + "-journal";
  fs::create_symlink(secret(), fs::path(golden_.path()) / journal);
  expect_refused(journal, "symbolic link");
}

TEST_F(ForeignGoldenFolder, ALinkInPlaceOfAFolderIsNotFollowed) {
  for (const char* folder : {"logs", "traces"}) {
    const fs::path path = fs::path(golden_.path()) / folder, kept = golden_.outside(folder);
    fs::rename(path, kept);
    fs::create_directory_symlink(kept, path);
    expect_refused(folder, "symbolic link");
    fs::remove(path);
    fs::rename(kept, path);
  }
}

TEST_F(ForeignGoldenFolder, NamesThatLeaveTheFolderAreRefused) {
  for (const char* name : {"../secret", "/etc/passwd", "logs/../../secret", "logs/a\\tb.csv"}) {
    const GoldenCopy golden;
    golden.edit("\"logs/locked_1.csv\"", std::string("\"") + name + "\"");
    const ProgramRun run = golden.run("check");
    EXPECT_EQ(run.status, 3) << name;
    EXPECT_NE(run.err.find("below the golden folder"), std::string::npos) << run.err;
  }
}

/// The names of a new model follow from its content, so that somebody who knows it can put a link there
/// before.
TEST_F(ForeignGoldenFolder, AcceptingAModelWritesThroughNoLink) {
  const std::string model = golden_.outside("new.json");
  write_file(model, read_file(golden_.file("", "model-")) + " ");
  fs::copy_file(golden_.file("", "cases-"), case_base_path(model));
  ASSERT_EQ(run_program({"model", "sign", model}).status, 0);
  const std::string hash = sha256_hex(read_file(model)).substr(0, 8);
  fs::create_symlink(secret(), fs::path(golden_.path()) / ("model-" + hash + ".json"));
  const std::string before = read_file(golden_.toml());
  const ProgramRun run = golden_.run("accept", {"--all", "--model", model});
  EXPECT_EQ(run.status, 3) << run.out << run.err;
  EXPECT_NE(run.err.find("model-" + hash + ".json"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("symbolic link"), std::string::npos) << run.err;
  EXPECT_EQ(read_file(secret()), "root:x:0:0:a secret line\n");
  EXPECT_EQ(read_file(golden_.toml()), before);
}

TEST_F(ForeignGoldenFolder, RecordingWritesThroughNoLink) {
  const std::string model = golden_.file("", "model-"), made = golden_.outside("made");
  fs::create_directories(made + "/logs");
  fs::create_symlink(secret(), made + "/logs/locked_1.csv");
  const ProgramRun run =
      run_program({"golden", "record", golden_.file("logs", "locked_1"), "--model", model, "--cases",
                   golden_.file("", "cases-"), "--no-identification", "-o", made});
  EXPECT_EQ(run.status, 3) << run.out << run.err;
  EXPECT_NE(run.err.find("symbolic link"), std::string::npos) << run.err;
  EXPECT_EQ(read_file(secret()), "root:x:0:0:a secret line\n");
  EXPECT_FALSE(fs::exists(made + "/golden.toml"));
}

}  // namespace
}  // namespace faultline
