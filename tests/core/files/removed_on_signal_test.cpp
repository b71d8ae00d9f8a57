// SPDX-License-Identifier: MIT
#include "lib/core/files/removed_on_signal.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "lib/core/atomic_file.hpp"
#include "lib/core/random.hpp"
#include "tests/support/signalled_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

int partial_files(const fs::path& folder) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(folder))
    count += entry.path().string().find(".partial-") != std::string::npos;
  return count;
}

/// Writes files without end, on several threads.
[[noreturn]] void write_for_ever(const TemporaryFolder& folder) {
  heed_signals();
  remove_files_on_signals();
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&folder, t] {
      for (int i = 0;; ++i) {
        const AtomicFile forgotten(folder.file("forgotten"));
        AtomicFile file(folder.file("file_" + std::to_string(t)));
        file.write(std::string(1000, static_cast<char>('a' + i % 26)));
        file.commit();
      }
    });
  while (true) ::pause();
}

TEST(RemovedOnSignal, ASignalEndsTheProgramAndLeavesNoPartialFile) {
  Random random(3);
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    for (int round = 0; round < 5; ++round) {
      const TemporaryFolder folder;
      const pid_t child = ::fork();
      if (child == 0) write_for_ever(folder);
      std::this_thread::sleep_for(std::chrono::duration<double>(random.uniform(0.05, 0.15)));
      ::kill(child, number);
      int status = 0;
      ::waitpid(child, &status, 0);
      EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == number) << status;
      EXPECT_EQ(partial_files(folder.path()), 0) << number;
      for (const auto& entry : fs::directory_iterator(folder.path()))
        EXPECT_EQ(read_file(entry.path().string()).size(), 1000u);
    }
}

TEST(RemovedOnSignal, AnIgnoredSignalStaysIgnored) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGHUP, SIG_IGN);
    remove_files_on_signals();
    ::raise(SIGHUP);
    ::_exit(7);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 7) << status;
}

}  // namespace
}  // namespace faultline
