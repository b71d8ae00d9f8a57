// SPDX-License-Identifier: MIT
#include "lib/core/files/inner_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <functional>

#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

/// A folder of somebody else, and a file that is none of theirs.
class InnerFile : public testing::Test {
 protected:
  InnerFile() {
    fs::create_directories(inner() + "/logs");
    fs::create_directories(root_.file("elsewhere"));
    secret_ = root_.write("elsewhere/secret.csv", "secret");
  }

  std::string inner() const { return root_.file("inner"); }
  std::string at(const std::string& path) const { return inner() + "/" + path; }

  void expect_refused(const std::function<void()>& use, ErrorCode code, const std::string& file,
                      const std::string& word) const {
    try {
      use();
      ADD_FAILURE() << file << " was used";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code);
      EXPECT_EQ(error.where(), at(file));
      EXPECT_NE(error.message().find(word), std::string::npos) << error.message();
    }
    EXPECT_EQ(read_file(secret_), "secret");
  }

  /// Neither read nor written, at once, and named with the word for what it is.
  void expect_unused(const std::string& path, const std::string& file, const std::string& word) const {
    expect_refused([&] { has_inner_file(inner(), path); }, ErrorCode::input, file, word);
    expect_refused([&] { read_inner_file(inner(), path); }, ErrorCode::input, file, word);
    expect_refused([&] { write_inner_file(inner(), path, "mine"); }, ErrorCode::output, file, word);
  }

  TemporaryFolder root_;
  std::string secret_;
};

TEST_F(InnerFile, ARegularFileInRealFoldersIsReadAndWritten) {
  EXPECT_FALSE(has_inner_file(inner(), "logs/a.csv"));
  EXPECT_FALSE(has_inner_file(inner(), "traces/a.csv"));
  write_inner_file(inner(), "logs/a.csv", "one");
  write_inner_file(inner(), "traces/a.csv", "two");
  EXPECT_TRUE(has_inner_file(inner(), "logs/a.csv"));
  EXPECT_EQ(read_inner_file(inner(), "traces/a.csv"), "two");
  write_inner_file(inner(), "logs/a.csv", "three");
  EXPECT_EQ(read_inner_file(inner(), "logs/a.csv"), "three");
  EXPECT_TRUE(has_inner_folder(inner(), "logs"));
  EXPECT_FALSE(has_inner_folder(inner(), "none"));
}

TEST_F(InnerFile, TheFolderItselfMayBeALink) {
  write_inner_file(inner(), "a.csv", "one");
  fs::create_directory_symlink(inner(), root_.file("link"));
  EXPECT_EQ(read_inner_file(root_.file("link"), "a.csv"), "one");
}

TEST_F(InnerFile, LinksAreNotFollowed) {
  fs::create_symlink(secret_, at("logs/a.csv"));
  expect_unused("logs/a.csv", "logs/a.csv", "symbolic link");
  fs::create_symlink("b.csv", at("logs/inside.csv"));
  expect_unused("logs/inside.csv", "logs/inside.csv", "symbolic link");
  fs::create_symlink(root_.file("elsewhere/new.csv"), at("logs/to_nothing.csv"));
  expect_unused("logs/to_nothing.csv", "logs/to_nothing.csv", "symbolic link");
  EXPECT_FALSE(fs::exists(root_.file("elsewhere/new.csv")));
}

TEST_F(InnerFile, ALinkInPlaceOfAFolderIsNotFollowed) {
  fs::create_directory_symlink(root_.file("elsewhere"), at("traces"));
  expect_unused("traces/secret.csv", "traces", "symbolic link");
  expect_unused("traces/new.csv", "traces", "symbolic link");
  expect_refused([&] { has_inner_folder(inner(), "traces"); }, ErrorCode::input, "traces", "symbolic link");
}

TEST_F(InnerFile, PipesDevicesAndFoldersAreNotOpened) {
  ASSERT_EQ(::mkfifo(at("logs/pipe").c_str(), 0600), 0);
  expect_unused("logs/pipe", "logs/pipe", "pipe");
  fs::create_symlink("/dev/zero", at("logs/zero"));
  expect_unused("logs/zero", "logs/zero", "symbolic link");
  fs::create_directory(at("logs/folder"));
  expect_unused("logs/folder", "logs/folder", "folder");
  write_file(at("file"), "x");
  expect_unused("file/below", "file", "not a folder");
}

TEST_F(InnerFile, AFileThatIsTooLongIsRefused) {
  write_file(at("long"), std::string((1 << 20) + 1, 'x'));
  expect_refused([&] { read_inner_file(inner(), "long", 1 << 20); }, ErrorCode::input, "long",
                 "larger than 1 MiB");
}

}  // namespace
}  // namespace faultline
