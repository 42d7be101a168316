// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_host.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/mission/conduct/conduct_errors.h"
#include "server/base/errors.h"

namespace plumescout::server {

MissionHost::MissionHost(Parts parts, const HostOptions& options)
    : id_(std::move(parts.id)),
      host_options_(options),
      mission_options_(parts.mission->options()),
      strategy_(std::move(parts.strategy)),
      leases_(options.lease_hold, options.first_lease_token, options.clock),
      writer_(std::move(parts.mission), std::move(parts.sink), parts.epoch_pool, SteadyNow,
              parts.audit_pool),
      waiters_(options.max_waiters),
      thread_([this] { Run(); }) {}

MissionHost::~MissionHost() { Stop(MissionNotFound(id_)); }

absl::Status MissionHost::Reserve(int observations) {
  absl::MutexLock lock(&mutex_);
  if (observations > host_options_.max_queued_observations - reserved_observations_) {
    return Overloaded(absl::StrCat("the ingest queue of mission ", id_, " is full"));
  }
  reserved_observations_ += observations;
  return absl::OkStatus();
}

void MissionHost::Release(int observations) {
  absl::MutexLock lock(&mutex_);
  reserved_observations_ -= observations;
}

absl::Status MissionHost::Post(Command command) {
  absl::MutexLock lock(&mutex_);
  if (stopping_) return stop_status_;
  if (commands_.size() >= static_cast<std::size_t>(host_options_.max_queued_commands)) {
    return Overloaded(absl::StrCat("the command queue of mission ", id_, " is full"));
  }
  commands_.push_back(std::move(command));
  return absl::OkStatus();
}

absl::Status MissionHost::AwaitBelief(BeliefRequest request, BeliefCallback done) {
  return Post([this, request = std::move(request), done = std::move(done)](MissionWriter&) {
    waiters_.Add(request, done);
  });
}

absl::Status MissionHost::Subscribe(Subscriber subscriber) {
  return Post([this, subscriber = std::move(subscriber)](MissionWriter& writer) {
    if (subscribers_.empty()) writer.BeginPublishing();
    if (subscriber(writer.conduct().Snapshot())) subscribers_.push_back(subscriber);
  });
}

void MissionHost::Wake() {
  // A full or stopped queue looks at the waiters anyway.
  Post([](MissionWriter&) {}).IgnoreError();
}

void MissionHost::Stop(const absl::Status& status) {
  {
    absl::MutexLock lock(&mutex_);
    if (!stopping_) stop_status_ = status;
    stopping_ = true;
  }
  if (thread_.joinable()) thread_.join();
}

bool MissionHost::TakeCommands(SteadyTime until, std::vector<Command>& commands) {
  absl::MutexLock lock(&mutex_);
  const absl::Condition has_work(this, &MissionHost::HasWork);
  if (until == SteadyTime::max()) {
    mutex_.Await(has_work);
  } else {
    mutex_.AwaitWithTimeout(has_work, absl::FromChrono(until - SteadyNow()));
  }
  commands.swap(commands_);
  return !commands.empty() || !stopping_;
}

void MissionHost::Run() {
  std::vector<Command> commands;
  while (TakeCommands(NextWake(), commands)) {
    for (const Command& command : commands) command(writer_);
    // Not under the lock: what commands hold may call us when it goes.
    commands.clear();
    AfterCommands();
  }
  absl::Status status;
  {
    absl::MutexLock lock(&mutex_);
    status = stop_status_;
  }
  waiters_.FailAll(status);
  Publish(status);
  subscribers_.clear();
  leases_.EndAll(status);
}

void MissionHost::AfterCommands() {
  writer_.CollectAudit();
  const SteadyTime now = SteadyNow();
  waiters_.Serve(writer_.conduct(), now);
  if (now >= next_publication()) {
    auto belief = writer_.Publish(host_options_.gas_wait);
    published_at_ = now;
    published_revision_ = belief->revision;
    Publish(std::move(belief));
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

SteadyTime MissionHost::NextWake() const {
  return std::min(waiters_.next_deadline(), next_publication());
}

}  // namespace plumescout::server
