// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/memory_store.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "server/store/store_errors.h"
#include "server/store/store_write.h"

namespace plumescout::server {
namespace {

struct ShelvedMission {
  AcquiredMission known;
  std::vector<std::string> records;

  std::int64_t bytes() const {
    std::size_t sum = known.header.size() + known.standing.size();
    for (const std::string& record : records) sum += record.size();
    for (const StoredSnapshot& snapshot : known.snapshots) sum += snapshot.bytes.size();
    return static_cast<std::int64_t>(sum);
  }
};

absl::Status AppendRecords(const StoreWrite& write, ShelvedMission& mission) {
  const std::int64_t head = mission.known.head;
  if (write.first_number != head + 1) return FencedByHead(write.key, write.first_number, head);
  mission.records.insert(mission.records.end(), write.records.begin(), write.records.end());
  mission.known.head += static_cast<std::int64_t>(write.records.size());
  return absl::OkStatus();
}

absl::Status KeepSnapshot(const StoreWrite& write, AcquiredMission& known) {
  const StoredSnapshot& snapshot = write.snapshot;
  if (snapshot.revision > known.head) {
    return SnapshotAhead(write.key, snapshot.revision, known.head);
  }
  std::vector<StoredSnapshot>& kept = known.snapshots;
  std::erase_if(kept, [&](const auto& other) { return other.revision == snapshot.revision; });
  kept.insert(std::find_if(kept.begin(), kept.end(),
                           [&](const auto& other) { return other.revision < snapshot.revision; }),
              snapshot);
  if (kept.size() > kKeptSnapshots) kept.resize(kKeptSnapshots);
  return absl::OkStatus();
}

}  // namespace

void TrimRecords(ShelvedMission& mission) {
  AcquiredMission& known = mission.known;
  if (known.snapshots.size() < kKeptSnapshots) return;
  const std::int64_t first = std::max(known.first, known.snapshots.back().revision + 1);
  mission.records.erase(mission.records.begin(), mission.records.begin() + (first - known.first));
  known.first = first;
}

// The missions. Thread-safe.
class MemoryStore::Shelf {
 public:
  absl::Status Apply(StoreWrite& write) {
    absl::MutexLock lock(&mutex_);
    const auto found = missions_.find(write.key);
    const bool stands = found != missions_.end();
    switch (write.kind) {
      case StoreWrite::Kind::kUndoCreate:
      case StoreWrite::Kind::kCompact:
        return absl::OkStatus();
      case StoreWrite::Kind::kCreate:
        if (stands) return AlreadyStored(write.key);
        missions_[write.key] = MakeMission(write.bytes);
        return absl::OkStatus();
      default:
        break;
    }
    if (!stands) return NotStored(write.key);
    if (write.kind == StoreWrite::Kind::kDiscard) return NotDamaged(write.key);
    const absl::Status status = ApplyTo(*found->second, write);
    if (status.ok() && write.kind == StoreWrite::Kind::kRemove) missions_.erase(found);
    return status;
  }

  // Null: there is none.
  std::shared_ptr<const ShelvedMission> Find(const std::string& key) const {
    absl::MutexLock lock(&mutex_);
    const auto found = missions_.find(key);
    return found == missions_.end() ? nullptr : found->second;
  }

  AcquiredMission Known(const ShelvedMission& mission) const {
    absl::MutexLock lock(&mutex_);
    return mission.known;
  }

  // Nothing if it was trimmed.
  std::optional<std::string> RecordOf(const ShelvedMission& mission, std::int64_t number) const {
    absl::MutexLock lock(&mutex_);
    if (number < mission.known.first) return std::nullopt;
    return mission.records[static_cast<std::size_t>(number - mission.known.first)];
  }

  std::vector<StoredMission> List() const {
    absl::MutexLock lock(&mutex_);
    std::vector<StoredMission> listed;
    for (const auto& [key, mission] : missions_) {
      const AcquiredMission& known = mission->known;
      listed.push_back({key, known.epoch, known.head, mission->bytes(), false, known.standing});
    }
    return listed;
  }

 private:
  static std::shared_ptr<ShelvedMission> MakeMission(const std::string& header) {
    const auto mission = std::make_shared<ShelvedMission>();
    mission->known.epoch = 1;
    mission->known.header = header;
    return mission;
  }

  static absl::Status ApplyTo(ShelvedMission& mission, StoreWrite& write) {
    AcquiredMission& known = mission.known;
    if (write.kind == StoreWrite::Kind::kAcquire) {
      ++known.epoch;
      if (write.acquired != nullptr) *write.acquired = known;
      return absl::OkStatus();
    }
    if (write.epoch != known.epoch) return FencedByEpoch(write.key, write.epoch, known.epoch);
    if (write.kind == StoreWrite::Kind::kAppend) return AppendRecords(write, mission);
    if (write.kind == StoreWrite::Kind::kSnapshot) return KeepSnapshot(write, known);
    if (write.kind == StoreWrite::Kind::kStanding) known.standing = write.bytes;
    if (write.kind == StoreWrite::Kind::kTrim) TrimRecords(mission);
    return absl::OkStatus();
  }

  mutable absl::Mutex mutex_;  // of what missions hold, too
  std::map<std::string, std::shared_ptr<ShelvedMission>> missions_ ABSL_GUARDED_BY(mutex_);
};

namespace {

// Goes on also when the mission was removed, or the store is gone.
template <typename Shelf>
class ShelfReader final : public JournalReader {
 public:
  ShelfReader(std::shared_ptr<Shelf> shelf, std::shared_ptr<const ShelvedMission> mission,
              std::string key, std::int64_t first)
      : shelf_(std::move(shelf)),
        mission_(std::move(mission)),
        key_(std::move(key)),
        next_(first),
        last_(shelf_->Known(*mission_).head) {}

  absl::StatusOr<std::optional<JournalRecord>> Next() override {
    if (next_ > last_) return std::optional<JournalRecord>();
    std::optional<std::string> bytes = shelf_->RecordOf(*mission_, next_);
    if (!bytes.has_value()) return NotKept(key_, shelf_->Known(*mission_).first - 1);
    return std::optional<JournalRecord>({next_++, *std::move(bytes)});
  }

 private:
  const std::shared_ptr<Shelf> shelf_;
  const std::shared_ptr<const ShelvedMission> mission_;
  const std::string key_;
  std::int64_t next_;
  const std::int64_t last_;
};

template <typename Shelf>
class ShelfEngine final : public WriteEngine {
 public:
  explicit ShelfEngine(std::shared_ptr<Shelf> shelf) : shelf_(std::move(shelf)) {}

  absl::Status Commit(std::span<StoreWrite> writes) override {
    for (StoreWrite& write : writes) write.result = shelf_->Apply(write);
    return absl::OkStatus();
  }

 private:
  const std::shared_ptr<Shelf> shelf_;
};

}  // namespace

MemoryStore::MemoryStore(bool is_durable) : MemoryStore(is_durable, std::make_shared<Shelf>()) {}

MemoryStore::MemoryStore(bool is_durable, std::shared_ptr<Shelf> shelf)
    : CommittedStore({}, std::make_unique<ShelfEngine<Shelf>>(shelf)),
      is_durable_(is_durable),
      shelf_(std::move(shelf)) {}

absl::StatusOr<std::unique_ptr<JournalReader>> MemoryStore::Read(const std::string& key,
                                                                 std::int64_t first_number) {
  ++read_count_;
  auto mission = shelf_->Find(key);
  if (mission == nullptr) return NotStored(key);
  if (first_number < 1) return BadFirstNumber(first_number);
  const std::int64_t first_kept = shelf_->Known(*mission).first;
  if (first_number < first_kept) return NotKept(key, first_kept - 1);
  return std::make_unique<ShelfReader<Shelf>>(shelf_, std::move(mission), key, first_number);
}

absl::StatusOr<AcquiredMission> MemoryStore::Peek(const std::string& key) {
  const auto mission = shelf_->Find(key);
  if (mission == nullptr) return NotStored(key);
  return shelf_->Known(*mission);
}

absl::StatusOr<std::vector<StoredMission>> MemoryStore::List() { return shelf_->List(); }

}  // namespace plumescout::server
