// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace plumescout {

// What goes wrong with a disk.
enum class DiskFault {
  kFull,     // no room for what is written
  kIoError,  // half of what is written arrives; a sync fails
};

// As long as it lives, whatever SQLite opens lies on a disk that fails when told to. It counts
// steps: writes, syncs, and changes of a file's size. Nothing is really synced, which is quick and
// shows in no test. One at a time; it outlives what is open on it. Thread-safe.
class FaultyDisk {
 public:
  FaultyDisk();
  ~FaultyDisk();
  FaultyDisk(const FaultyDisk&) = delete;
  FaultyDisk& operator=(const FaultyDisk&) = delete;

  // The step that comes after `steps_ahead` others fails, and `for_ever` all those behind it.
  void FailAfter(int steps_ahead, DiskFault fault, bool for_ever);
  void Heal();

  int steps() const { return steps_; }
  bool has_failed() const { return failures_ > 0; }

  // By the files.
  bool TakeStep();
  DiskFault fault() const { return fault_; }

 private:
  std::atomic<int> steps_ = 0;
  std::atomic<int> first_failing_;
  std::atomic<int> last_failing_;
  std::atomic<int> failures_ = 0;
  std::atomic<DiskFault> fault_ = DiskFault::kFull;
};

}  // namespace plumescout
