// SPDX-License-Identifier: MIT
#include "tests/support/run_program.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Limits a resource; the address space not under the address sanitizer, which takes terabytes of it.
void limit(__rlimit_resource resource, long long bytes) {
#ifdef __SANITIZE_ADDRESS__
  if (resource == RLIMIT_AS) return;
#endif
  if (bytes < 0) return;
  const rlimit both{static_cast<rlim_t>(bytes), static_cast<rlim_t>(bytes)};
  ::setrlimit(resource, &both);
}

void redirect(int descriptor, const std::string& path) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file < 0 || ::dup2(file, descriptor) < 0) ::_exit(126);
  ::close(file);
}

[[noreturn]] void become_program(const std::vector<std::string>& words, const RunOptions& options,
                                 const std::string& out, const std::string& err) {
  redirect(1, out);
  redirect(2, err);
  limit(RLIMIT_FSIZE, options.file_size_limit);
  limit(RLIMIT_AS, options.memory_limit);
  for (const std::string& setting : options.environment) ::putenv(const_cast<char*>(setting.c_str()));
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  ::execvp(argv.front(), argv.data());
  ::_exit(127);
}

}  // namespace

ProgramRun run_program(const std::vector<std::string>& arguments, const RunOptions& options) {
  std::vector<std::string> words{FAULTLINE_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run_command(words, options);
}

ProgramRun run_command(const std::vector<std::string>& words, const RunOptions& options) {
  const TemporaryFolder folder;
  const std::string captured = folder.file("stdout"), err = folder.file("stderr");
  const std::string out = options.stdout_path.empty() ? captured : options.stdout_path;
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0) become_program(words, options, out, err);
  int state = 0;
  ::waitpid(child, &state, 0);
  ProgramRun run;
  run.status = WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
  run.out = text_of(captured);
  run.err = text_of(err);
  return run;
}

}  // namespace faultline
