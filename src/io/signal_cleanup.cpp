// SPDX-License-Identifier: BSD-3-Clause
#include "io/signal_cleanup.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>

#include "pcl_gpf/io/atomic_file.h"

namespace pcl_gpf {

namespace {

// A signal handler may use neither locks nor the heap, so the paths lie in a fixed table.
enum SlotState { kFree, kBeingFilled, kInUse };
static_assert(std::atomic<int>::is_always_lock_free, "the signal handler needs a lock-free flag");

struct Slot {
  std::atomic<int> state{kFree};
  char path[PATH_MAX] = {};
};

constexpr int kSlots = 64;
Slot slots[kSlots];

void removeTemporaries(int signal_number) {
  const int saved_error = errno;
  for (Slot& slot : slots)
    if (slot.state.load(std::memory_order_acquire) == kInUse) ::unlink(slot.path);
  ::signal(signal_number, SIG_DFL);
  ::raise(signal_number); // is delivered when the handler returns
  errno = saved_error;
}

void installHandler(int signal_number) {
  struct sigaction current {};
  if (::sigaction(signal_number, nullptr, &current) != 0 || current.sa_handler == SIG_IGN) return;
  struct sigaction action {};
  action.sa_handler = removeTemporaries;
  ::sigemptyset(&action.sa_mask);
  ::sigaction(signal_number, &action, nullptr);
}

} // namespace

int rememberTemporary(const std::string& path) noexcept {
  if (path.size() >= PATH_MAX) return -1;
  for (int i = 0; i < kSlots; ++i) {
    int expected = kFree;
    if (!slots[i].state.compare_exchange_strong(expected, kBeingFilled)) continue;
    std::memcpy(slots[i].path, path.c_str(), path.size() + 1);
    slots[i].state.store(kInUse, std::memory_order_release);
    return i;
  }
  return -1;
}

void forgetTemporary(int slot) noexcept {
  if (slot >= 0) slots[slot].state.store(kFree, std::memory_order_release);
}

void installSignalCleanup() {
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP})
    installHandler(signal_number);
  ::signal(SIGXFSZ, SIG_IGN);
}

} // namespace pcl_gpf
