// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "absl/synchronization/mutex.h"
#include "tests/support/memory_store.h"

namespace plumescout::server {

inline StoreState WithBacklog(std::int64_t bytes) {
  StoreState state;
  state.backlog_bytes = bytes;
  return state;
}
inline StoreState Refusing(absl::string_view why) {
  StoreState state;
  state.status = absl::UnavailableError(why);
  return state;
}

// A store that says it is durable and takes its time: while it holds, what is appended waits until
// it is released, as on a disk that hangs.
class HeldStore : public MissionStore {
 public:
  void Hold() {
    absl::MutexLock lock(&mutex_);
    holds_ = true;
  }
  // The oldest write that waits, which there is.
  void ReleaseOne() { TakeOldest()(); }
  // All of them, in their order, and those to come.
  void Release() {
    while (!HoldsNoMore()) ReleaseOne();
  }
  int held() const {
    absl::MutexLock lock(&mutex_);
    return static_cast<int>(writes_.size());
  }
  void AwaitHeld(int writes) const {
    const auto reached = [this, writes] {
      mutex_.AssertHeld();
      return static_cast<int>(writes_.size()) >= writes;
    };
    absl::MutexLock lock(&mutex_);
    mutex_.Await(absl::Condition(&reached));
  }
  // So many acquisitions to come fail, as on a disk that is full for a while.
  void RefuseAcquisitions(int count) { refused_acquisitions_ = count; }
  // The same of journals to be read.
  void RefuseReads(int count) { refused_reads_ = count; }
  // What state() says from now on.
  void set_state(StoreState state) {
    absl::MutexLock lock(&mutex_);
    state_ = std::move(state);
  }

  absl::StatusOr<std::int64_t> Create(const std::string& key, const std::string& header) override {
    return store_.Create(key, header);
  }
  absl::StatusOr<AcquiredMission> Acquire(const std::string& key) override {
    if (refused_acquisitions_ > 0) {
      --refused_acquisitions_;
      return absl::UnavailableError("the disk is full");
    }
    return store_.Acquire(key);
  }
  absl::StatusOr<std::unique_ptr<JournalReader>> Read(const std::string& key,
                                                      std::int64_t first_number) override {
    if (refused_reads_ > 0) {
      --refused_reads_;
      return absl::UnavailableError("no more files can be opened");
    }
    return store_.Read(key, first_number);
  }
  absl::StatusOr<AcquiredMission> Peek(const std::string& key) override { return store_.Peek(key); }
  void Append(const std::string& key, std::int64_t epoch, std::int64_t first_number,
              std::vector<std::string> records, Done done) override {
    Write([=, this, records = std::move(records), done = std::move(done)] {
      store_.Append(key, epoch, first_number, records, done);
    });
  }
  void PutStanding(const std::string& key, std::int64_t epoch, std::string standing,
                   Done done) override {
    Write([=, this] { store_.PutStanding(key, epoch, standing, done); });
  }
  void PutSnapshot(const std::string& key, std::int64_t epoch, StoredSnapshot snapshot,
                   Done done) override {
    Write([=, this] { store_.PutSnapshot(key, epoch, snapshot, done); });
  }
  void Trim(const std::string& key, std::int64_t epoch, Done done) override {
    Write([=, this] { store_.Trim(key, epoch, done); });
  }
  void Remove(const std::string& key, std::int64_t epoch, Done done) override {
    Write([=, this] { store_.Remove(key, epoch, done); });
  }
  void Discard(const std::string& key, Done done) override {
    Write([=, this] { store_.Discard(key, done); });
  }
  absl::StatusOr<std::vector<StoredMission>> List() override { return store_.List(); }
  StoreState state() const override {
    absl::MutexLock lock(&mutex_);
    return state_;
  }
  bool is_durable() const override { return true; }

 private:
  void Write(std::function<void()> write) {
    {
      absl::MutexLock lock(&mutex_);
      if (holds_) return writes_.push_back(std::move(write));
    }
    write();
  }
  bool HoldsNoMore() {
    absl::MutexLock lock(&mutex_);
    if (writes_.empty()) holds_ = false;
    return writes_.empty();
  }
  std::function<void()> TakeOldest() {
    absl::MutexLock lock(&mutex_);
    auto oldest = std::move(writes_.front());
    writes_.pop_front();
    return oldest;
  }

  std::atomic<int> refused_acquisitions_ = 0;
  std::atomic<int> refused_reads_ = 0;
  MemoryStore store_{/*is_durable=*/true};
  mutable absl::Mutex mutex_;
  bool holds_ ABSL_GUARDED_BY(mutex_) = false;
  std::deque<std::function<void()>> writes_ ABSL_GUARDED_BY(mutex_);
  StoreState state_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
