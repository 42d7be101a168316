// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/committed_store.h"

#include <utility>

#include "core/types/status_macros.h"

namespace plumescout::server {
namespace {

using Kind = StoreWrite::Kind;

constexpr std::int64_t kFirstEpoch = 1;

StoreWrite MakeWrite(Kind kind, const std::string& key, std::int64_t epoch,
                     MissionStore::Done done) {
  StoreWrite write;
  write.kind = kind;
  write.key = key;
  write.epoch = epoch;
  write.done = std::move(done);
  return write;
}

}  // namespace

CommittedStore::CommittedStore(const CommitterOptions& options, std::unique_ptr<WriteEngine> engine)
    : engine_(std::move(engine)), committer_(options, engine_.get()) {}

absl::StatusOr<std::int64_t> CommittedStore::Create(const std::string& key,
                                                    const std::string& header) {
  StoreWrite write = MakeWrite(Kind::kCreate, key, kFirstEpoch, nullptr);
  write.bytes = header;
  PLUMESCOUT_RETURN_IF_ERROR(committer_.SubmitAndWait(std::move(write)));
  return kFirstEpoch;
}

absl::StatusOr<AcquiredMission> CommittedStore::Acquire(const std::string& key) {
  AcquiredMission acquired;
  StoreWrite write = MakeWrite(Kind::kAcquire, key, 0, nullptr);
  write.acquired = &acquired;
  PLUMESCOUT_RETURN_IF_ERROR(committer_.SubmitAndWait(std::move(write)));
  return acquired;
}

void CommittedStore::Append(const std::string& key, std::int64_t epoch, std::int64_t first_number,
                            std::vector<std::string> records, Done done) {
  StoreWrite write = MakeWrite(Kind::kAppend, key, epoch, std::move(done));
  write.first_number = first_number;
  write.records = std::move(records);
  committer_.Submit(std::move(write));
}

void CommittedStore::PutStanding(const std::string& key, std::int64_t epoch, std::string standing,
                                 Done done) {
  StoreWrite write = MakeWrite(Kind::kStanding, key, epoch, std::move(done));
  write.bytes = std::move(standing);
  committer_.Submit(std::move(write));
}

void CommittedStore::PutSnapshot(const std::string& key, std::int64_t epoch,
                                 StoredSnapshot snapshot, Done done) {
  StoreWrite write = MakeWrite(Kind::kSnapshot, key, epoch, std::move(done));
  write.snapshot = std::move(snapshot);
  committer_.Submit(std::move(write));
}

void CommittedStore::Trim(const std::string& key, std::int64_t epoch, Done done) {
  committer_.Submit(MakeWrite(Kind::kTrim, key, epoch, std::move(done)));
}

void CommittedStore::Remove(const std::string& key, std::int64_t epoch, Done done) {
  committer_.Submit(MakeWrite(Kind::kRemove, key, epoch, std::move(done)));
}

void CommittedStore::Discard(const std::string& key, Done done) {
  committer_.Submit(MakeWrite(Kind::kDiscard, key, 0, std::move(done)));
}

StoreState CommittedStore::state() const { return committer_.state(); }

}  // namespace plumescout::server
