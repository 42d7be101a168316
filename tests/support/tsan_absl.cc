// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
//
// Debian's libabsl is not built with ThreadSanitizer, which therefore does not see that its mutexes
// order anything and calls every guarded access a race. Preloaded before it, these wrappers say so:
// what happened before a release is visible after the next acquire, and what the library does
// inside is none of our business. Programs that such a test starts have it preloaded as well, and
// no ThreadSanitizer: hence the weak symbols.
#include <dlfcn.h>

#include "absl/synchronization/blocking_counter.h"
#include "absl/synchronization/mutex.h"
#include "absl/synchronization/notification.h"

extern "C" {
[[gnu::weak]] void __tsan_acquire(void* address);
[[gnu::weak]] void __tsan_release(void* address);
[[gnu::weak]] void AnnotateIgnoreReadsBegin(const char* file, int line);
[[gnu::weak]] void AnnotateIgnoreReadsEnd(const char* file, int line);
[[gnu::weak]] void AnnotateIgnoreWritesBegin(const char* file, int line);
[[gnu::weak]] void AnnotateIgnoreWritesEnd(const char* file, int line);
}

namespace {

class Unwatched {
 public:
  Unwatched() {
    AnnotateIgnoreReadsBegin(__FILE__, __LINE__);
    AnnotateIgnoreWritesBegin(__FILE__, __LINE__);
  }
  ~Unwatched() {
    AnnotateIgnoreWritesEnd(__FILE__, __LINE__);
    AnnotateIgnoreReadsEnd(__FILE__, __LINE__);
  }
};

// The library's own function of this mangled name.
template <typename Result, typename... Arguments>
auto* Real(const char* name) {
  return reinterpret_cast<Result (*)(Arguments...)>(dlsym(RTLD_NEXT, name));
}

template <typename Function, typename... Arguments>
auto Call(Function* function, Arguments&&... arguments) {
  const Unwatched unwatched;
  return function(arguments...);
}

// Waits give the mutex up and take it again.
template <typename Function, typename... Arguments>
auto CallReleased(void* mutex, Function* function, Arguments&&... arguments) {
  struct Reacquire {
    void* mutex;
    ~Reacquire() { __tsan_acquire(mutex); }
  };
  __tsan_release(mutex);
  const Reacquire reacquire{mutex};
  return Call(function, arguments...);
}

}  // namespace

namespace absl {
inline namespace debian3 {

void Mutex::Lock() {
  static auto* const real = Real<void, Mutex*>("_ZN4absl7debian35Mutex4LockEv");
  Call(real, this);
  __tsan_acquire(this);
}
void Mutex::Unlock() {
  static auto* const real = Real<void, Mutex*>("_ZN4absl7debian35Mutex6UnlockEv");
  __tsan_release(this);
  Call(real, this);
}
bool Mutex::TryLock() {
  static auto* const real = Real<bool, Mutex*>("_ZN4absl7debian35Mutex7TryLockEv");
  const bool locked = Call(real, this);
  if (locked) __tsan_acquire(this);
  return locked;
}
void Mutex::ReaderLock() {
  static auto* const real = Real<void, Mutex*>("_ZN4absl7debian35Mutex10ReaderLockEv");
  Call(real, this);
  __tsan_acquire(this);
}
void Mutex::ReaderUnlock() {
  static auto* const real = Real<void, Mutex*>("_ZN4absl7debian35Mutex12ReaderUnlockEv");
  __tsan_release(this);
  Call(real, this);
}
void Mutex::Await(const Condition& condition) {
  static auto* const real =
      Real<void, Mutex*, const Condition*>("_ZN4absl7debian35Mutex5AwaitERKNS0_9ConditionE");
  CallReleased(this, real, this, &condition);
}
bool Mutex::AwaitWithTimeout(const Condition& condition, Duration timeout) {
  static auto* const real = Real<bool, Mutex*, const Condition*, Duration>(
      "_ZN4absl7debian35Mutex16AwaitWithTimeoutERKNS0_9ConditionENS0_8DurationE");
  return CallReleased(this, real, this, &condition, timeout);
}

bool Mutex::AwaitWithDeadline(const Condition& condition, Time deadline) {
  static auto* const real = Real<bool, Mutex*, const Condition*, Time>(
      "_ZN4absl7debian35Mutex17AwaitWithDeadlineERKNS0_9ConditionENS0_4TimeE");
  return CallReleased(this, real, this, &condition, deadline);
}

void CondVar::Wait(Mutex* mutex) {
  static auto* const real =
      Real<void, CondVar*, Mutex*>("_ZN4absl7debian37CondVar4WaitEPNS0_5MutexE");
  CallReleased(mutex, real, this, mutex);
}
bool CondVar::WaitWithTimeout(Mutex* mutex, Duration timeout) {
  static auto* const real = Real<bool, CondVar*, Mutex*, Duration>(
      "_ZN4absl7debian37CondVar15WaitWithTimeoutEPNS0_5MutexENS0_8DurationE");
  return CallReleased(mutex, real, this, mutex, timeout);
}
bool CondVar::WaitWithDeadline(Mutex* mutex, Time deadline) {
  static auto* const real = Real<bool, CondVar*, Mutex*, Time>(
      "_ZN4absl7debian37CondVar16WaitWithDeadlineEPNS0_5MutexENS0_4TimeE");
  return CallReleased(mutex, real, this, mutex, deadline);
}

void Notification::Notify() {
  static auto* const real = Real<void, Notification*>("_ZN4absl7debian312Notification6NotifyEv");
  __tsan_release(this);
  Call(real, this);
}
void Notification::WaitForNotification() const {
  static auto* const real =
      Real<void, const Notification*>("_ZNK4absl7debian312Notification19WaitForNotificationEv");
  Call(real, this);
  __tsan_acquire(const_cast<Notification*>(this));
}

bool Notification::WaitForNotificationWithTimeout(Duration timeout) const {
  static auto* const real = Real<bool, const Notification*, Duration>(
      "_ZNK4absl7debian312Notification30WaitForNotificationWithTimeoutENS0_8DurationE");
  const bool notified = Call(real, this, timeout);
  if (notified) __tsan_acquire(const_cast<Notification*>(this));
  return notified;
}
bool Notification::WaitForNotificationWithDeadline(Time deadline) const {
  static auto* const real = Real<bool, const Notification*, Time>(
      "_ZNK4absl7debian312Notification31WaitForNotificationWithDeadlineENS0_4TimeE");
  const bool notified = Call(real, this, deadline);
  if (notified) __tsan_acquire(const_cast<Notification*>(this));
  return notified;
}

bool BlockingCounter::DecrementCount() {
  static auto* const real =
      Real<bool, BlockingCounter*>("_ZN4absl7debian315BlockingCounter14DecrementCountEv");
  __tsan_release(this);
  return Call(real, this);
}
void BlockingCounter::Wait() {
  static auto* const real =
      Real<void, BlockingCounter*>("_ZN4absl7debian315BlockingCounter4WaitEv");
  Call(real, this);
  __tsan_acquire(this);
}

}  // namespace debian3
}  // namespace absl
