// SPDX-License-Identifier: MIT
#include "lib/core/files/temporary_file.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

mode_t mode_of(const std::string& path) {
  struct stat facts {};
  ::stat(path.c_str(), &facts);
  return facts.st_mode & 0777;
}

/// A process that has begun to write `path` and waits, dead or alive.
class Writer {
 public:
  Writer(const std::string& path, bool killed) {
    int ready[2];
    if (::pipe(ready) != 0) throw std::runtime_error("no pipe");
    child_ = ::fork();
    if (child_ == 0) {
      const TemporaryFile file(path);
      if (::write(file.descriptor(), "half", 4) != 4 || ::write(ready[1], "!", 1) != 1) ::_exit(1);
      while (true) ::pause();
    }
    ::close(ready[1]);
    char answer = 0;
    if (::read(ready[0], &answer, 1) != 1) throw std::runtime_error("the writer failed");
    ::close(ready[0]);
    if (killed) kill();
  }
  ~Writer() { kill(); }

 private:
  void kill() {
    if (child_ <= 0) return;
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
    child_ = -1;
  }

  pid_t child_ = -1;
};

TEST(TemporaryFile, IsRemovedUnlessItIsCommitted) {
  const TemporaryFolder folder;
  { const TemporaryFile file(folder.file("a")); }
  EXPECT_TRUE(names_in(folder.path()).empty());
  TemporaryFile file(folder.file("a"));
  EXPECT_NE(names_in(folder.path()).front().find("a.partial-"), std::string::npos);
  file.commit();
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"a"});
}

TEST(TemporaryFile, FilesOfADeadProgramAreRemovedAndThoseOfALivingOneKept) {
  const TemporaryFolder folder;
  const Writer living(folder.file("living"), false), dead(folder.file("dead"), true);
  ASSERT_EQ(names_in(folder.path()).size(), 2u);
  write_file(folder.file("new"), "whole");
  const auto names = names_in(folder.path());
  ASSERT_EQ(names.size(), 2u);
  EXPECT_EQ(names[0].rfind("living.partial-", 0), 0u);
  EXPECT_EQ(names[1], "new");
}

TEST(TemporaryFile, OldFilesOfAnotherMachineAreRemovedAndOtherFilesKept) {
  const TemporaryFolder folder;
  const auto old = fs::file_time_type::clock::now() - std::chrono::hours(48);
  std::string there = temporary_name("a.json"), new_there = temporary_name("b.json");
  for (std::string* name : {&there, &new_there}) {
    char& digit = (*name)[name->rfind('-') + 1];  // of the machine
    digit = digit == '0' ? '1' : '0';
  }
  const std::vector<std::string> others = {"c.json.partial-999999999-77", "report.partial-draft",
                                           "x.partial-0123456789abcdef"};
  fs::last_write_time(folder.write(there, "x"), old);
  folder.write(new_there, "written just now");
  for (const std::string& name : others) fs::last_write_time(folder.write(name, "x"), old);
  remove_abandoned_files(folder.path().string());
  std::vector<std::string> left = {new_there};
  left.insert(left.end(), others.begin(), others.end());
  EXPECT_EQ(names_in(folder.path()), left);
}

TEST(TemporaryFile, NamesAreUniqueAndRecognised) {
  const std::string one = temporary_name("folder/a.json"), other = temporary_name("folder/a.json");
  EXPECT_NE(one, other);
  EXPECT_EQ(one.rfind("folder/a.json.partial-", 0), 0u);
  EXPECT_EQ(temporary_kind(one), TemporaryKind::this_machine);
  EXPECT_FALSE(is_temporary_name("a.json"));
}

TEST(AtomicFile, AnExistingFileKeepsItsMode) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a", "old");
  for (const mode_t mode : {0600, 0640, 0666, 0755}) {
    ASSERT_EQ(::chmod(path.c_str(), mode), 0);
    write_file(path, "new");
    EXPECT_EQ(mode_of(path), mode);
  }
}

TEST(AtomicFile, AReadOnlyFileIsNotReplaced) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everything";
  const TemporaryFolder folder;
  const std::string path = folder.write("a", "old");
  ASSERT_EQ(::chmod(path.c_str(), 0444), 0);
  EXPECT_THROW(write_file(path, "new"), Error);
  EXPECT_EQ(read_file(path), "old");
}

TEST(AtomicFile, SymbolicLinksAreFollowedAlsoToAMissingFile) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "far");
  folder.write("far/real", "old");
  fs::create_symlink("far/second", folder.path() / "first");
  fs::create_symlink("real", folder.path() / "far/second");
  fs::create_symlink("far/not_yet", folder.path() / "open");
  write_file(folder.file("first"), "new");
  write_file(folder.file("open"), "made");
  EXPECT_EQ(read_file(folder.file("far/real")), "new");
  EXPECT_EQ(read_file(folder.file("far/not_yet")), "made");
  for (const char* link : {"first", "open", "far/second"})
    EXPECT_TRUE(fs::is_symlink(folder.path() / link)) << link;
  EXPECT_EQ(names_in(folder.path() / "far"), (std::vector<std::string>{"not_yet", "real", "second"}));
}

TEST(AtomicFile, CircularLinksAreRefused) {
  const TemporaryFolder folder;
  fs::create_symlink("b", folder.path() / "a");
  fs::create_symlink("a", folder.path() / "b");
  EXPECT_THROW(write_file(folder.file("a"), "x"), Error);
  EXPECT_EQ(names_in(folder.path()), (std::vector<std::string>{"a", "b"}));
}

TEST(AtomicFile, TheLongestNameCanBeWritten) {
  const TemporaryFolder folder;
  const std::string name(255, 'n');
  write_file(folder.file(name), "x");
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{name});
}

TEST(AtomicFile, AFolderIsRefusedBeforeAnythingIsWritten) {
  const TemporaryFolder folder;
  EXPECT_THROW(AtomicFile(folder.path().string()), Error);
}

}  // namespace
}  // namespace faultline
