// SPDX-License-Identifier: MIT
#include "formats/hdf5/hdf5_trial.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <exception>

#include "formats/hdf5/hdf5_library.hpp"

namespace faultline {
namespace {

constexpr rlim_t kLongest_s = 10;

/// Never returns. What the library or the C library says of its end is not shown.
[[noreturn]] void try_in_copy(const std::function<void()>& work) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGALRM}) std::signal(signal, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  const rlimit no_core{0, 0}, time{kLongest_s, kLongest_s};
  ::setrlimit(RLIMIT_CORE, &no_core);
  ::setrlimit(RLIMIT_CPU, &time);
  Hdf5Turn::be_alone();
  ::alarm(static_cast<unsigned>(kLongest_s));
  try {
    work();
  } catch (const std::exception&) {
    ::_exit(0);
  }
  ::_exit(0);
}

}  // namespace

bool survives(const std::function<void()>& work) {
  const Hdf5Turn turn;  // so that no other thread is within the library when the copy is made
  const pid_t copy = ::fork();
  if (copy < 0) return true;
  if (copy == 0) try_in_copy(work);
  int status = 0;
  while (::waitpid(copy, &status, 0) < 0)
    if (errno != EINTR) return true;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace faultline
