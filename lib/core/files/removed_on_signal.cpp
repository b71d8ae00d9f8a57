// SPDX-License-Identifier: MIT
#include "lib/core/files/removed_on_signal.hpp"

#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>

namespace faultline {

enum SlotState { kFree, kBeingSet, kArmed, kTaken };

/// A path that the signal handler may read. Slots are reused and never freed, so that the handler may
/// traverse them at any moment.
struct SignalSlot {
  std::atomic<int> state{kBeingSet};
  std::array<char, PATH_MAX> path{};
  SignalSlot* next = nullptr;

  bool change(int from, int to) { return state.compare_exchange_strong(from, to); }
};

namespace {

static_assert(std::atomic<int>::is_always_lock_free && std::atomic<SignalSlot*>::is_always_lock_free);

std::atomic<SignalSlot*> first_slot = nullptr;
std::atomic<bool> ending = false;
std::atomic<int> held = 0;  ///< threads that are creating a file

constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};
constexpr int kLongestWait_ms = 1000;

sigset_t all_signals() {
  sigset_t set;
  ::sigemptyset(&set);
  for (const int number : kSignals) ::sigaddset(&set, number);
  return set;
}

SignalSlot* claim_slot() {
  for (SignalSlot* slot = first_slot; slot; slot = slot->next)
    if (slot->change(kFree, kBeingSet)) return slot;
  auto* fresh = new SignalSlot;
  fresh->next = first_slot;
  while (!first_slot.compare_exchange_weak(fresh->next, fresh)) {
  }
  return fresh;
}

/// Uses only what POSIX allows in a handler.
extern "C" void end_by_signal(int number) {
  ending = true;
  for (int ms = 0; held > 0 && ms < kLongestWait_ms; ++ms) ::poll(nullptr, 0, 1);
  for (SignalSlot* slot = first_slot; slot; slot = slot->next)
    if (slot->change(kArmed, kTaken)) ::unlink(slot->path.data());
  ::signal(number, SIG_DFL);
  sigset_t itself;
  ::sigemptyset(&itself);
  ::sigaddset(&itself, number);
  ::pthread_sigmask(SIG_UNBLOCK, &itself, nullptr);
  ::raise(number);
}

}  // namespace

void remove_files_on_signals() {
  struct sigaction action {};
  action.sa_handler = end_by_signal;
  action.sa_mask = all_signals();
  for (const int number : kSignals) {
    struct sigaction before {};
    if (::sigaction(number, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
      ::sigaction(number, &action, nullptr);
  }
}

void wait_if_ending() {
  while (ending) ::pause();
}

HeldSignals::HeldSignals() {
  const sigset_t all = all_signals();
  ::pthread_sigmask(SIG_BLOCK, &all, &before_);
  ++held;
  if (!ending) return;
  --held;
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  wait_if_ending();
}

HeldSignals::~HeldSignals() {
  --held;
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

RemovedOnSignal::RemovedOnSignal(const std::string& path) : slot_(nullptr) {
  if (path.size() >= PATH_MAX) return;
  slot_ = claim_slot();
  slot_->path.fill('\0');
  path.copy(slot_->path.data(), path.size());
  slot_->state = kArmed;
}

RemovedOnSignal::~RemovedOnSignal() {
  if (slot_ && !slot_->change(kArmed, kFree)) wait_if_ending();
}

}  // namespace faultline
