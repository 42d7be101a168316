// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_host.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

#include "absl/strings/str_cat.h"
#include "core/mission/conduct/conduct_errors.h"
#include "core/mission/observation_check.h"
#include "core/types/status_macros.h"
#include "proto/convert/prior_map.h"
#include "server/base/errors.h"

namespace plumescout::server {
namespace {

constexpr std::int64_t kMaxRememberedBytes = 2 << 20;  // the last plans of some dozens of robots
// Of a mission that moves to another server, whose robots wait meanwhile.
constexpr std::int64_t kLeastTailOfMoving_bytes = 32 * 1024;

std::unique_ptr<Mission> AbandonedWith(std::shared_ptr<const std::atomic<bool>> flag,
                                       std::unique_ptr<Mission> mission) {
  mission->AbandonWhen([flag = std::move(flag)] { return flag->load(); });
  return mission;
}

EpochHabit HabitOf(const MissionJournal& journal, const JournalTail& tail) {
  return journal.is_durable() ? EpochHabit{kEventsPerEpoch, tail.last_epoch} : EpochHabit{};
}

std::unique_ptr<SnapshotTaker> MakeTaker(const std::shared_ptr<MissionJournal>& journal,
                                         WorkerPool* pool, const JournalTail& tail) {
  if (!journal->is_durable() || pool == nullptr) return nullptr;
  return std::make_unique<SnapshotTaker>(journal, pool, tail);
}

}  // namespace

MissionHost::MissionHost(Parts parts, const HostOptions& options)
    : id_(std::move(parts.id)),
      owner_(std::move(parts.owner)),
      metrics_(*parts.metrics),
      host_options_(options),
      mission_options_(parts.mission->options()),
      strategy_(std::move(parts.strategy)),
      leases_(options.lease_hold, options.first_lease_token, options.clock),
      room_(std::make_shared<IngestRoom>(
          IngestLoad{options.max_queued_observations, options.max_queued_bytes})),
      abandoned_(std::make_shared<std::atomic<bool>>(false)),
      standing_(id_, options.clock),
      journal_(parts.journal != nullptr ? std::move(parts.journal)
                                        : std::make_shared<MissionJournal>()),
      snapshots_(MakeTaker(journal_, parts.snapshot_pool, parts.tail)),
      recording_(std::move(parts.recording)),
      sink_(std::move(parts.sink)),
      rates_(options.rates, options.clock),
      requests_(std::make_shared<RequestMemory>(
          RequestMemoryOptions{.max_bytes = kMaxRememberedBytes, .clock = options.clock})),
      map_feed_(std::make_shared<MapFeed>(id_, options.max_map_part_bytes)),
      robot_notices_(std::make_shared<RobotNotices>(parts.metrics, options.max_watchers_per_robot)),
      waiters_(options.max_waiters),
      writer_(
          AbandonedWith(abandoned_, std::move(parts.mission)),
          [this](const Event& event, const Applied& applied) { Keep(event, applied); },
          parts.epoch_pool, SteadyNow, parts.audit_pool, parts.metrics,
          HabitOf(*journal_, parts.tail)),
      clock_gate_({options.max_clock_lead, mission_options_.stamp_by_arrival}, options.wall_clock),
      mission_clock_(options.wall_clock, options.clock) {
  standing_.Restore(parts.standing.state, parts.standing.idle_time_to_live,
                    parts.standing.event_retention);
  journal_->set_trims(parts.standing.event_retention == EventRetention::kSinceSnapshot);
  if (writer_.mission().revision() > 0) RecoverLeases(parts.standing);
  // The writer, which may sleep, collects it.
  writer_.OnAuditFinding([this] { Post([](MissionWriter&) {}).IgnoreError(); });
  writer_.conduct().PutOffRefreshesWhile([this] { return IsBeliefWanted(); });
  thread_ = std::thread([this] { Run(); });
}

MissionHost::~MissionHost() { Stop(MissionNotFound(id_)); }

void MissionHost::Keep(const Event& event, const Applied& applied) {
  if (const auto* removed = std::get_if<RobotRemoved>(&event.body)) {
    robot_clocks_.Forget(removed->robot);
  }
  const std::int64_t bytes = journal_->Add(event);
  if (snapshots_ != nullptr) snapshots_->NoteEvent(event, bytes, writer_.mission());
  if (recording_ != nullptr) recording_->Note(event, applied, writer_.mission());
  if (sink_) sink_(event);
}

void MissionHost::RecoverLeases(const StandingRecord& standing) {
  const std::shared_ptr<const Belief> belief = writer_.conduct().Snapshot();
  for (const auto& [robot, record] : belief->robots) {
    const auto token = writer_.mission().LeaseToken(robot);
    if (!token.ok()) continue;
    leases_.Grant(robot, *token);
    const auto released = standing.released_leases.find(robot);
    const bool is_released = released != standing.released_leases.end();
    if (is_released && released->second == *token) leases_.Release(robot, *token).IgnoreError();
  }
}

const v1::PriorMap& MissionHost::prior_map() {
  absl::call_once(prior_map_packed_, [this] { prior_map_ = ToProto(*mission_options_.prior_map); });
  return prior_map_;
}

HostLoad MissionHost::load() const {
  HostLoad load;
  load.waiting_calls = waiters_.size();
  load.watchers = map_feed_->reader_count();
  const SteadyTime since = unpublished_since_;
  if (load.watchers > 0 && since != SteadyTime::max())
    load.unpublished = absl::FromChrono(SteadyNow() - since);
  load.reserved_observations = room_->used().observations;
  absl::MutexLock lock(&mutex_);
  load.queued_commands = static_cast<int>(commands_.size());
  return load;
}

IngestResult MissionHost::Ingest(MissionWriter& writer, const RobotId& robot,
                                 std::int64_t lease_token, std::vector<IncomingObservation> batch,
                                 const BatchTimes& times) {
  MissionConduct& conduct = writer.conduct();
  const auto refuse = [&](const absl::Status& status) {
    return IngestResult{status, conduct.Position(robot).value_or(LogPosition{}), {}};
  };
  if (const absl::Status writable = CheckMayWrite(); !writable.ok()) return refuse(writable);
  absl::Status leased = conduct.CheckLease(robot, lease_token);
  leased.Update(leases_.CheckNotReleased(robot, lease_token));  // while the batch waited
  if (!leased.ok()) return refuse(leased);
  const std::int64_t in_force_ns = writer.mission().StateOf(robot).value().clock_offset_ns;
  const auto [offset_ns, was_set] = robot_clocks_.Reckon(robot, times, in_force_ns);
  IngestResult result;
  if (was_set) {
    result = IngestMapped(writer, robot, lease_token,
                          TakeMadeBefore(in_force_ns - offset_ns, times.sent_ns, batch),
                          ClockGate::Mapped{in_force_ns, times.arrived_ns});
    if (!result.status.ok()) return result;
  }
  const absl::Status noted = conduct.NoteClock({robot, offset_ns}, lease_token);
  if (!noted.ok()) return refuse(noted);
  const auto mapped =
      times.sent_ns == 0
          ? std::nullopt
          : std::optional(ClockGate::Mapped{.offset_ns = offset_ns, .now_ns = times.arrived_ns});
  IngestResult rest = IngestMapped(writer, robot, lease_token, std::move(batch), mapped);
  rest.refused.insert(rest.refused.begin(), std::make_move_iterator(result.refused.begin()),
                      std::make_move_iterator(result.refused.end()));
  return rest;
}

IngestResult MissionHost::IngestMapped(MissionWriter& writer, const RobotId& robot,
                                       std::int64_t lease_token,
                                       std::vector<IncomingObservation> batch,
                                       const std::optional<ClockGate::Mapped>& mapped) {
  clock_gate_.Pass(robot, batch, mapped);
  std::optional<std::int64_t> newest_ns;
  for (const IncomingObservation& incoming : batch) {
    const bool has_time = mapped && incoming.unreadable.ok() &&
                          !std::holds_alternative<SequenceGap>(incoming.observation.payload);
    if (has_time) newest_ns = MissionTime_ns(incoming.observation, mapped->offset_ns);
  }
  IngestResult result = writer.conduct().Ingest(robot, lease_token, std::move(batch));
  robot_clocks_.NoteBatch(robot, {.heard_ns = mission_clock_.now_ns(),
                                  .newest_sample_ns = newest_ns,
                                  .offset_ns = mapped ? mapped->offset_ns : 0});
  return result;
}

absl::Status MissionHost::CheckMayWrite() const {
  PLUMESCOUT_RETURN_IF_ERROR(standing_.CheckMayWrite());
  return journal_->CheckTakesMore();
}

absl::Status MissionHost::CheckMayPlan() const {
  PLUMESCOUT_RETURN_IF_ERROR(standing_.CheckMayPlan());
  return journal_->CheckTakesMore();
}

void MissionHost::KeepStanding() {
  absl::MutexLock lock(&keep_standing_);
  const EventRetention retention = standing_.event_retention();
  journal_->PutStanding(EncodeStanding(
      {standing_.state(), standing_.idle_time_to_live(), leases_.Released(), retention}));
  journal_->set_trims(retention == EventRetention::kSinceSnapshot);
  robot_notices_->Follow(leases_, standing_.state());
}

void MissionHost::CloseStream(const RobotId& robot, StreamId stream) {
  leases_.CloseStream(robot, stream);
  // The writer, which may sleep, has to see when the lease runs out.
  if (robot_notices_->watcher_count() > 0) Post([](MissionWriter&) {}).IgnoreError();
}

void MissionHost::WhenDurable(MissionJournal::Callback done) {
  const SteadyTime deadline = After(SteadyNow(), host_options_.max_wait);
  journal_->WhenDurable(summary().revision, deadline, std::move(done));
  // The writer, which may sleep, has to see to the deadline.
  const bool waits = journal_->next_deadline() != SteadyTime::max();
  if (waits && writer_thread_.load() != std::this_thread::get_id()) {
    Post([](MissionWriter&) {}).IgnoreError();
  }
}

absl::Status MissionHost::Post(Command command) {
  const bool bounded = command.room == nullptr;
  absl::MutexLock lock(&mutex_);
  if (stopping_) return stop_status_;
  if (bounded && bounded_commands_ >= host_options_.max_queued_commands) {
    return Overloaded(absl::StrCat("the command queue of mission ", id_, " is full"));
  }
  if (bounded) ++bounded_commands_;
  commands_.push_back(std::move(command));
  return absl::OkStatus();
}

absl::Status MissionHost::AwaitBelief(BeliefRequest request, BeliefCallback done) {
  request.deadline = std::min(request.deadline, After(SteadyNow(), host_options_.max_wait));
  ++queued_wishes_;
  const std::shared_ptr<void> wish(nullptr, [this](void*) { --queued_wishes_; });
  return Post(
      [this, request = std::move(request), done, wish](MissionWriter& writer) {
        waiters_.Add(request, done, writer.conduct(), SteadyNow());
      },
      [done](const absl::Status& status) { done(status); });
}

absl::Status MissionHost::Subscribe(Subscriber subscriber) {
  return Post(
      [this, subscriber](MissionWriter& writer) {
        if (subscribers_.empty()) writer.BeginPublishing();
        if (subscriber(writer.conduct().Snapshot())) subscribers_.push_back(subscriber);
      },
      [subscriber](const absl::Status& status) { subscriber(status); });
}

void MissionHost::EndWaits(const absl::Status& status) {
  waiters_.Close(status);
  end_listeners_.End(status);
}

void MissionHost::BeginStop(const absl::Status& status) {
  absl::MutexLock lock(&mutex_);
  if (!stopping_) stop_status_ = status;
  stopping_ = true;
  *abandoned_ = true;
}

void MissionHost::DropAll() {
  std::deque<Command> dropped;
  absl::Status status;
  {
    absl::MutexLock lock(&mutex_);
    status = stop_status_;
    dropped.swap(commands_);
    bounded_commands_ = 0;
  }
  // One by one, so that the room of each is free when its caller hears.
  while (!dropped.empty()) {
    const OnDropped drop = std::move(dropped.front().drop);
    dropped.pop_front();
    if (drop) drop(status);
  }
  EndWaits(status);
  leases_.EndAll(status);
  journal_->Close(status);
}

void MissionHost::Stop(const absl::Status& status) {
  BeginStop(status);
  DropAll();
  if (thread_.joinable()) thread_.join();
}

std::optional<std::size_t> MissionHost::AwaitCommands(SteadyTime until) {
  absl::MutexLock lock(&mutex_);
  const absl::Condition has_work(this, &MissionHost::HasWork);
  if (until == SteadyTime::max()) {
    mutex_.Await(has_work);
  } else {
    mutex_.AwaitWithTimeout(has_work, absl::FromChrono(until - SteadyNow()));
  }
  if (stopping_) return std::nullopt;
  return commands_.size();
}

std::optional<MissionHost::Command> MissionHost::NextCommand() {
  absl::MutexLock lock(&mutex_);
  if (stopping_ || resting_ || commands_.empty()) return std::nullopt;
  Command command = std::move(commands_.front());
  commands_.pop_front();
  if (command.room == nullptr) --bounded_commands_;
  return command;
}

void MissionHost::Run() {
  writer_thread_ = std::this_thread::get_id();
  while (const auto count = AwaitCommands(NextWake())) {
    const int waited_before = waiters_.size();
    for (std::size_t i = 0; i < *count; ++i) {
      std::optional<Command> command = NextCommand();
      if (!command.has_value()) break;
      command->room = nullptr;  // it waits no more
      // Who waits since this batch is served after it; who did before may be, if more commands
      // come.
      more_follow_ = i + 1 < *count || waiters_.size() > waited_before;
      command->run(writer_);
      journal_->FlushIfIdle();
    }
    journal_->Flush();
    AfterCommands();
    journal_->Flush();
  }
  journal_->Flush();
  if (recording_ != nullptr) recording_->End(writer_.mission());
  DropAll();
  const auto why = [this] {
    absl::MutexLock lock(&mutex_);
    return stop_status_;
  };
  Publish(why());
  subscribers_.clear();
}

bool MissionHost::IsReadyToSleep() {
  if (!journal_->is_durable()) return false;
  const HostLoad now = load();
  if (now.watchers > 0 || now.waiting_calls > 0 || now.queued_commands > 0) return false;
  const std::int64_t revision = summary().revision;
  if (settled_revision_ == revision) {
    return journal_->is_stored() && journal_->durable_revision() == revision &&
           journal_->CheckTakesMore().ok() && !is_taking_snapshot();
  }
  Post([this](MissionWriter&) { Settle(kLeastTail_bytes); }).IgnoreError();
  return false;
}

absl::Status MissionHost::BeginSnapshot(std::function<void()> begun) {
  return Post(
      [this, begun](MissionWriter&) {
        Settle(kLeastTailOfMoving_bytes);
        begun();
      },
      [begun](const absl::Status&) { begun(); });
}

absl::Status MissionHost::BeginRest(MissionJournal::Callback rests) {
  return Post(
      [this, rests](MissionWriter&) {
        {
          absl::MutexLock lock(&mutex_);
          resting_ = true;
        }
        WhenDurable(rests);
      },
      rests);
}

void MissionHost::Settle(std::int64_t least_tail_bytes) {
  // Without a field there is no epoch, and the events are replayed.
  if (snapshots_ != nullptr && snapshots_->WantOne(least_tail_bytes))
    writer_.conduct().RenewField().IgnoreError();
  settled_revision_ = writer_.mission().revision();
}

void MissionHost::AfterCommands() {
  if (*abandoned_ || IsResting()) return;
  writer_.CollectAudit();
  const SteadyTime now = SteadyNow();
  journal_->DropOverdue(now);
  waiters_.Serve(writer_.conduct(), now);
  if (now >= next_publication()) {
    auto belief = writer_.Publish(host_options_.gas_wait);
    published_at_ = now;
    published_revision_ = belief->revision;
    Publish(std::move(belief));
  }
  unpublished_since_ = writer_.unpublished_since();
  robot_notices_->Follow(leases_, standing_.state());
  if (now >= robot_notices_->next_look(writer_.mission().revision())) {
    robot_notices_->Look(writer_.conduct().Snapshot(), now);
  }
}

SteadyTime MissionHost::next_publication() const {
  if (subscribers_.empty()) return SteadyTime::max();
  const bool news = published_revision_ != writer_.mission().revision();
  return std::min(news ? After(published_at_, host_options_.publish_period) : SteadyTime::max(),
                  After(writer_.unpublished_since(), host_options_.gas_wait));
}

void MissionHost::Publish(const absl::StatusOr<std::shared_ptr<const Belief>>& belief) {
  std::erase_if(subscribers_, [&](const Subscriber& subscriber) { return !subscriber(belief); });
}

bool MissionHost::IsResting() const {
  absl::MutexLock lock(&mutex_);
  return resting_;
}

SteadyTime MissionHost::NextWake() const {
  if (IsResting()) return SteadyTime::max();
  return std::min({waiters_.next_deadline(), next_publication(), journal_->next_deadline(),
                   robot_notices_->next_look(writer_.mission().revision()),
                   robot_notices_->next_follow(leases_, SteadyNow())});
}

}  // namespace plumescout::server
