// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/fair_pool.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "absl/strings/str_cat.h"
#include "server/base/errors.h"
#include "server/base/thread_priority.h"

namespace plumescout::server {
namespace {

// The first entry after `last`, round the end, that is `wanted`; end() if there is none.
template <typename Map, typename Wanted>
typename Map::iterator NextInTurn(Map& map, const std::string& last, const Wanted& wanted) {
  auto it = map.upper_bound(last);
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (it == map.end()) it = map.begin();
    if (wanted(*it)) return it;
    ++it;
  }
  return map.end();
}

template <typename Map>
typename Map::mapped_type const* Find(const Map& map, const std::string& name) {
  const auto found = map.find(name);
  return found == map.end() ? nullptr : &found->second;
}

template <typename Children>
void EraseIdle(Children& children) {
  std::erase_if(children, [](const auto& child) { return child.second.IsIdle(); });
}

// Who is not alone leaves so much of the queue to others.
constexpr int kPartLeft = 4;
// Of which one is for a core that long tasks do not have: servers have a thread more than cores.
constexpr int kThreadsLeft = 2;
// Beyond so many groups, those that have not asked for long are forgotten.
constexpr std::size_t kMaxPaces = 256;

}  // namespace

void FairPool::Company::Note(const std::string& who, SteadyTime now) {
  if (who != latest_) others_at_ = latest_at_;
  latest_ = who;
  latest_at_ = now;
}

bool FairPool::Company::IsAlone(const std::string& who, SteadyTime now) const {
  const SteadyTime asked = who == latest_ ? others_at_ : latest_at_;
  return asked == SteadyTime() || now > After(asked, kCompany);
}

FairPool::FairPool(const FairPoolOptions& options, SteadyClock clock)
    : options_(options), clock_(std::move(clock)) {
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
  NoteAsked(key);
  absl::Status room = CheckRoom(key);
  if (!room.ok()) {
    abandoned = TakeAbandoned();
    room = CheckRoom(key);
  }
  if (!room.ok()) {
    ++refused_;
    return room;
  }
  Tenant& tenant = all_.children[key.tenant];
  Group& group = tenant.children[key.group];
  group.children[key.member].tasks.push_back(std::move(task));
  ++group.queued;
  ++tenant.queued;
  ++all_.queued;
  return absl::OkStatus();
}

void FairPool::NoteAsked(const FairKey& key) {
  const SteadyTime now = clock_();
  tenants_.Note(key.tenant, now);
  groups_.Note(key.group, now);
  if (paces_.size() >= kMaxPaces) {
    std::erase_if(paces_,
                  [now](const auto& pace) { return now > After(pace.second.asked, kCompany); });
  }
  const GroupName name(key.tenant, key.group);
  if (paces_.size() < kMaxPaces || paces_.contains(name)) paces_[name].asked = now;
}

int FairPool::Places(const FairKey& key, const Tenant* tenant, const Group* group) const {
  const SteadyTime now = clock_();
  const bool leaves_tenants =
      tenant != nullptr && tenant->queued > 0 && !tenants_.IsAlone(key.tenant, now);
  const bool leaves_groups = options_.groups_leave_room && group != nullptr && group->queued > 0 &&
                             !groups_.IsAlone(key.group, now);
  const bool leaves = leaves_tenants || leaves_groups;
  return leaves ? options_.max_queued - options_.max_queued / kPartLeft : options_.max_queued;
}

absl::Status FairPool::CheckRoom(const FairKey& key) const {
  const Tenant* const tenant = Find(all_.children, key.tenant);
  const Group* const group = tenant == nullptr ? nullptr : Find(tenant->children, key.group);
  if (all_.queued >= Places(key, tenant, group)) {
    return Overloaded(absl::StrCat("the ", options_.name, " queue is full"));
  }
  if (group == nullptr) return absl::OkStatus();
  if (group->queued >= options_.max_queued_per_group) {
    return Overloaded(absl::StrCat("the ", options_.name, " queue of ", key.group, " is full"));
  }
  const Member* const member = Find(group->children, key.member);
  if (member == nullptr ||
      member->tasks.size() < static_cast<std::size_t>(options_.max_queued_per_member)) {
    return absl::OkStatus();
  }
  return Overloaded(
      absl::StrCat("the ", options_.name, " queue of ", key.member, " in ", key.group, " is full"));
}

void FairPool::TakeAbandoned(Group& group, std::vector<FairTask>& taken) {
  for (auto& [name, member] : group.children) {
    std::deque<FairTask>& tasks = member.tasks;
    const auto first = std::stable_partition(
        tasks.begin(), tasks.end(), [](const FairTask& task) { return !task.abandoned(); });
    group.queued -= static_cast<int>(std::distance(first, tasks.end()));
    std::move(first, tasks.end(), std::back_inserter(taken));
    tasks.erase(first, tasks.end());
  }
  EraseIdle(group.children);
}

std::vector<FairTask> FairPool::TakeAbandoned() {
  std::vector<FairTask> taken;
  for (auto& [name, tenant] : all_.children) {
    const std::size_t before = taken.size();
    for (auto& [group_name, group] : tenant.children) TakeAbandoned(group, taken);
    tenant.queued -= static_cast<int>(taken.size() - before);
    EraseIdle(tenant.children);
  }
  all_.queued -= static_cast<int>(taken.size());
  EraseIdle(all_.children);
  return taken;
}

int FairPool::Threads(bool alone) const {
  return alone ? options_.threads : std::max(1, options_.threads - 1);
}

bool FairPool::MayRun(const Member& member) const {
  return !member.tasks.empty() && member.running < options_.max_running_per_member;
}

bool FairPool::TakesLong(const Pace& pace, SteadyTime now) {
  return pace.long_at != SteadyTime() && now <= After(pace.long_at, kLongKnown);
}

bool FairPool::TakesLong(const GroupName& name, SteadyTime now) const {
  const auto found = paces_.find(name);
  return found != paces_.end() && TakesLong(found->second, now);
}

int FairPool::RunningLong(SteadyTime now) const {
  int running = 0;
  for (const auto& [tenant_name, tenant] : all_.children) {
    if (tenant.running == 0) continue;
    for (const auto& [name, group] : tenant.children) {
      if (group.running > 0 && TakesLong({tenant_name, name}, now)) running += group.running;
    }
  }
  return running;
}

FairPool::Moment FairPool::Present() const {
  Moment moment = {.now = clock_()};
  if (options_.threads < 2) return moment;
  const bool is_last = all_.running >= options_.threads - 1;
  const int most_long = std::max(1, options_.threads - kThreadsLeft);
  if (!is_last && RunningLong(moment.now) < most_long) return moment;
  moment.holds_long = std::any_of(paces_.begin(), paces_.end(), [&moment](const auto& entry) {
    const Pace& pace = entry.second;
    return !TakesLong(pace, moment.now) && moment.now <= After(pace.asked, kCompany);
  });
  return moment;
}

bool FairPool::MayRun(const GroupName& name, const Group& group, const Moment& moment) const {
  const bool alone = !options_.groups_leave_room || groups_.IsAlone(name.second, moment.now);
  return !(moment.holds_long && TakesLong(name, moment.now)) &&
         group.running < std::min(options_.max_running_per_group, Threads(alone)) &&
         std::any_of(group.children.begin(), group.children.end(),
                     [this](const auto& entry) { return MayRun(entry.second); });
}

bool FairPool::MayRun(const std::string& name, const Tenant& tenant, const Moment& moment) const {
  return tenant.running < Threads(tenants_.IsAlone(name, moment.now)) &&
         std::any_of(tenant.children.begin(), tenant.children.end(), [&](const auto& entry) {
           mutex_.AssertHeld();
           return MayRun({name, entry.first}, entry.second, moment);
         });
}

bool FairPool::Ready() const {
  if (all_.queued == 0) return stopping_;
  const Moment moment = Present();
  return std::any_of(all_.children.begin(), all_.children.end(), [&](const auto& entry) {
    mutex_.AssertHeld();
    return MayRun(entry.first, entry.second, moment);
  });
}

std::optional<FairPool::Turn> FairPool::TakeTurn() {
  if (all_.queued == 0) return std::nullopt;
  const Moment moment = Present();
  const auto tenant = NextInTurn(all_.children, all_.last, [&](const auto& entry) {
    mutex_.AssertHeld();
    return MayRun(entry.first, entry.second, moment);
  });
  if (tenant == all_.children.end()) return std::nullopt;
  const auto group =
      NextInTurn(tenant->second.children, tenant->second.last, [&](const auto& entry) {
        mutex_.AssertHeld();
        return MayRun({tenant->first, entry.first}, entry.second, moment);
      });
  const auto member = NextInTurn(group->second.children, group->second.last,
                                 [this](const auto& entry) { return MayRun(entry.second); });
  Turn turn{{group->first, member->first, tenant->first}, std::move(member->second.tasks.front())};
  member->second.tasks.pop_front();
  ++member->second.running;
  const auto note = [](auto& party, const std::string& child) {
    party.last = child;
    ++party.running;
    --party.queued;
  };
  note(group->second, member->first);
  note(tenant->second, group->first);
  note(all_, tenant->first);
  return turn;
}

void FairPool::NoteEnd(const FairKey& key, bool is_long) {
  const auto pace = paces_.find({key.tenant, key.group});
  if (is_long && pace != paces_.end()) pace->second.long_at = clock_();
  Tenant& tenant = all_.children[key.tenant];
  Group& group = tenant.children[key.group];
  --group.children[key.member].running;
  --group.running;
  --tenant.running;
  --all_.running;
  EraseIdle(group.children);
  EraseIdle(tenant.children);
  EraseIdle(all_.children);
}

void FairPool::Run() {
  if (options_.yields) YieldCpuToOthers();
  while (true) {
    std::optional<Turn> turn;
    {
      absl::MutexLock lock(&mutex_);
      mutex_.Await(absl::Condition(this, &FairPool::Ready));
      turn = TakeTurn();
    }
    if (!turn) return;
    const SteadyTime began = clock_();
    if (!turn->task.abandoned()) turn->task.run();
    turn->task = {};
    const bool is_long = clock_() > After(began, kLong);
    absl::MutexLock lock(&mutex_);
    NoteEnd(turn->key, is_long);
  }
}

PoolLoad FairPool::load() const {
  absl::MutexLock lock(&mutex_);
  return {options_.name, options_.threads,    all_.running,
          all_.queued,   options_.max_queued, refused_};
}

int FairPool::queued() const {
  absl::MutexLock lock(&mutex_);
  return all_.queued;
}

}  // namespace plumescout::server
