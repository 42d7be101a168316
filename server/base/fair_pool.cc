// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/fair_pool.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "absl/strings/str_cat.h"
#include "server/base/errors.h"

namespace plumescout::server {
namespace {

// The first entry after `last`, round the end, that is `wanted`; end() if there is none.
template <typename Map, typename Wanted>
typename Map::iterator NextInTurn(Map& map, const std::string& last, const Wanted& wanted) {
  auto it = map.upper_bound(last);
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (it == map.end()) it = map.begin();
    if (wanted(it->second)) return it;
    ++it;
  }
  return map.end();
}

}  // namespace

FairPool::FairPool(const FairPoolOptions& options) : options_(options) {
  for (int i = 0; i < options_.threads; ++i) threads_.emplace_back([this] { Run(); });
}

FairPool::~FairPool() {
  {
    absl::MutexLock lock(&mutex_);
    stopping_ = true;
  }
  for (std::thread& thread : threads_) thread.join();
}

absl::Status FairPool::Submit(const FairKey& key, FairTask task) {
  std::vector<FairTask> abandoned;  // what they hold goes outside the lock
  absl::MutexLock lock(&mutex_);
  absl::Status room = CheckRoom(key);
  if (!room.ok()) {
    abandoned = TakeAbandoned();
    room = CheckRoom(key);
  }
  if (!room.ok()) {
    ++refused_;
    return room;
  }
  Group& group = groups_[key.group];
  group.members[key.member].tasks.push_back(std::move(task));
  ++group.queued;
  ++queued_;
  return absl::OkStatus();
}

absl::Status FairPool::CheckRoom(const FairKey& key) const {
  if (queued_ >= options_.max_queued) {
    return Overloaded(absl::StrCat("the ", options_.name, " queue is full"));
  }
  const auto group = groups_.find(key.group);
  if (group == groups_.end()) return absl::OkStatus();
  if (group->second.queued >= options_.max_queued_per_group) {
    return Overloaded(absl::StrCat("the ", options_.name, " queue of ", key.group, " is full"));
  }
  const auto member = group->second.members.find(key.member);
  if (member == group->second.members.end() ||
      member->second.tasks.size() < static_cast<std::size_t>(options_.max_queued_per_member)) {
    return absl::OkStatus();
  }
  return Overloaded(
      absl::StrCat("the ", options_.name, " queue of ", key.member, " in ", key.group, " is full"));
}

std::vector<FairTask> FairPool::TakeAbandoned() {
  std::vector<FairTask> taken;
  for (auto group = groups_.begin(); group != groups_.end();) {
    for (auto& [name, member] : group->second.members) {
      std::deque<FairTask>& tasks = member.tasks;
      const auto first = std::stable_partition(
          tasks.begin(), tasks.end(), [](const FairTask& task) { return !task.abandoned(); });
      const auto count = static_cast<int>(std::distance(first, tasks.end()));
      group->second.queued -= count;
      queued_ -= count;
      std::move(first, tasks.end(), std::back_inserter(taken));
      tasks.erase(first, tasks.end());
    }
    std::erase_if(group->second.members, [](const auto& entry) { return entry.second.IsIdle(); });
    EraseIfIdle(group++);
  }
  return taken;
}

bool FairPool::MayRun(const Group& group) const {
  return group.running < options_.max_running_per_group &&
         std::any_of(group.members.begin(), group.members.end(),
                     [](const auto& entry) { return entry.second.MayRun(); });
}

bool FairPool::Ready() const {
  if (stopping_ && queued_ == 0) return true;
  return std::any_of(groups_.begin(), groups_.end(),
                     [this](const auto& entry) { return MayRun(entry.second); });
}

FairPool::Groups::iterator FairPool::NextGroup() {
  return NextInTurn(groups_, last_group_, [this](const Group& group) { return MayRun(group); });
}

FairTask FairPool::TakeTask(Group& group) {
  const auto member =
      NextInTurn(group.members, group.last_member, [](const Member& one) { return one.MayRun(); });
  FairTask task = std::move(member->second.tasks.front());
  group.last_member = member->first;
  member->second.tasks.pop_front();
  member->second.running = true;
  ++group.running;
  --group.queued;
  --queued_;
  return task;
}

void FairPool::EraseIfIdle(Groups::iterator group) {
  if (group->second.queued == 0 && group->second.running == 0) groups_.erase(group);
}

void FairPool::NoteEnd(const FairKey& key) {
  --busy_;
  const auto group = groups_.find(key.group);
  --group->second.running;
  const auto member = group->second.members.find(key.member);
  member->second.running = false;
  if (member->second.IsIdle()) group->second.members.erase(member);
  EraseIfIdle(group);
}

void FairPool::Run() {
  while (true) {
    FairTask task;
    FairKey key;
    {
      absl::MutexLock lock(&mutex_);
      mutex_.Await(absl::Condition(this, &FairPool::Ready));
      const auto group = NextGroup();
      if (group == groups_.end()) return;
      last_group_ = group->first;
      ++busy_;
      task = TakeTask(group->second);
      key = {group->first, group->second.last_member};
    }
    if (!task.abandoned()) task.run();
    task = {};
    absl::MutexLock lock(&mutex_);
    NoteEnd(key);
  }
}

PoolLoad FairPool::load() const {
  absl::MutexLock lock(&mutex_);
  return {options_.name, options_.threads, busy_, queued_, options_.max_queued, refused_};
}

int FairPool::queued() const {
  absl::MutexLock lock(&mutex_);
  return queued_;
}

}  // namespace plumescout::server
