// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/snapshot_taker.h"

#include <time.h>

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

#include "absl/strings/str_cat.h"
#include "server/base/log.h"
#include "server/missions/mission_snapshot.h"

namespace plumescout::server {
namespace {

// What a recovery may take beside reading the snapshot.
constexpr absl::Duration kReplayLimit = absl::Seconds(2);

}  // namespace

absl::Duration ThreadCpuNow() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return absl::DurationFromTimespec(time);
}

SnapshotTaker::SnapshotTaker(std::shared_ptr<MissionJournal> journal, WorkerPool* pool,
                             const JournalTail& tail, ThreadClock clock)
    : journal_(std::move(journal)), pool_(pool), clock_(std::move(clock)), tail_bytes_(tail.bytes) {
  on_its_way_->bytes = tail.snapshot_bytes;
}

void SnapshotTaker::NoteEvent(const Event& event, std::int64_t bytes, const Mission& mission) {
  if (tail_from_ == absl::InfiniteDuration()) tail_from_ = clock_();
  tail_bytes_ += bytes;
  if (IsDue(event, mission)) Take(mission);
}

bool SnapshotTaker::WantOne(std::int64_t least_tail_bytes) {
  is_wanted_ = tail_bytes_ > least_tail_bytes;
  return is_wanted_;
}

bool SnapshotTaker::IsDue(const Event& event, const Mission& mission) {
  if (!std::holds_alternative<EpochAdopted>(event.body)) return false;
  if (on_its_way_->busy || !mission.can_be_saved()) return false;
  return is_wanted_ || tail_bytes_ > std::max(kLeastTail_bytes, on_its_way_->bytes.load()) ||
         clock_() - tail_from_ > kReplayLimit;
}

void SnapshotTaker::Take(const Mission& mission) {
  auto state = mission.SaveState();
  if (!state.ok()) {
    LogWarning("no snapshot", {{"why", std::string(state.status().message())}});
    return;
  }
  is_wanted_ = false;
  tail_bytes_ = 0;
  tail_from_ = clock_();
  on_its_way_->busy = true;
  const auto done = [way = on_its_way_](const absl::Status& status) {
    way->busy = false;
    if (!status.ok()) LogWarning("no snapshot", {{"why", std::string(status.message())}});
  };
  const auto pack = [journal = journal_, way = on_its_way_, done, revision = mission.revision(),
                     digest = mission.Digest(),
                     state = std::make_shared<const std::string>(*std::move(state))] {
    StoredSnapshot snapshot = PackSnapshot(revision, digest, *state);
    way->bytes = static_cast<std::int64_t>(snapshot.bytes.size());
    journal->PutSnapshot(std::move(snapshot), done);
  };
  journal_->WhenDurable(mission.revision(), SteadyTime::max(),
                        [pool = pool_, pack, done](const absl::Status& durable) {
                          const absl::Status queued = durable.ok() ? pool->Submit(pack) : durable;
                          if (!queued.ok()) done(queued);
                        });
}

}  // namespace plumescout::server
