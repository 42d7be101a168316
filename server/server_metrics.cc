// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/server_metrics.h"

#include <prometheus/client_metric.h>
#include <prometheus/metric_family.h>
#include <prometheus/text_serializer.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

#include "absl/time/time.h"
#include "server/base/log.h"
#include "server/base/version.h"
#include "server/observe/process_usage.h"

namespace plumescout::server {
namespace {

using prometheus::ClientMetric;
using prometheus::MetricFamily;
using prometheus::MetricType;
using Labels = std::vector<ClientMetric::Label>;

double Seconds(SteadyTime since) {
  return absl::ToDoubleSeconds(absl::FromChrono(SteadyNow() - since));
}

// Metrics that are read when they are asked for.
class Readings {
 public:
  explicit Readings(std::vector<MetricFamily>& families) : families_(families) {}

  // The values that are added from now on are of this gauge, or counter.
  void Gauge(std::string name, std::string help) {
    families_.push_back({std::move(name), std::move(help), MetricType::Gauge, {}});
  }
  void Counter(std::string name, std::string help) {
    families_.push_back({std::move(name), std::move(help), MetricType::Counter, {}});
  }
  template <typename Number>
  void Add(Number value, Labels labels = {}) {
    ClientMetric metric;
    metric.label = std::move(labels);
    metric.gauge.value = metric.counter.value = static_cast<double>(value);
    families_.back().metric.push_back(std::move(metric));
  }

 private:
  std::vector<MetricFamily>& families_;
};

void ReadServer(const ServerState& state, Readings& readings) {
  readings.Gauge("plumescout_server_info", "1; the labels tell of the server.");
  readings.Add(1, {{"version", kVersion}, {"boot_id", state.boot_id}});
  readings.Gauge("plumescout_uptime_seconds", "Time since the server started.");
  readings.Add(Seconds(state.began));
  readings.Gauge("plumescout_draining", "1 once the server goes out of service.");
  readings.Add(state.draining ? 1 : 0);
  readings.Gauge("plumescout_open_streams", "Streams that are open.");
  readings.Add(state.streams->size());
  const LineCounts lines = LogLineCounts();
  readings.Counter("plumescout_log_lines_total", "Lines written to the log.");
  readings.Add(lines.written);
  readings.Counter("plumescout_log_lines_dropped_total",
                   "Log lines dropped because nobody read the log fast enough.");
  readings.Add(lines.dropped);
}

void ReadProcess(Readings& readings) {
  const ProcessUsage usage = ReadProcessUsage();
  readings.Gauge("plumescout_process_resident_memory_bytes", "Memory of the process in RAM.");
  readings.Add(usage.resident_bytes);
  readings.Gauge("plumescout_process_open_fds", "Open file descriptors of the process.");
  readings.Add(usage.open_fds);
  readings.Gauge("plumescout_process_max_fds", "File descriptors that the process may open.");
  readings.Add(usage.max_fds);
  readings.Gauge("plumescout_process_threads", "Threads of the process.");
  readings.Add(usage.threads);
  readings.Counter("plumescout_process_cpu_seconds_total",
                   "CPU time of the process, user and system.");
  readings.Add(usage.cpu_s);
}

void ReadPools(const ServerState& state, Readings& readings) {
  const auto read = [&](auto PoolLoad::*figure) {
    for (const PoolLoad& load : state.pools) readings.Add(load.*figure, {{"pool", load.name}});
  };
  readings.Gauge("plumescout_pool_threads", "Threads of a pool.");
  read(&PoolLoad::threads);
  readings.Gauge("plumescout_pool_busy_threads", "Threads of a pool that work.");
  read(&PoolLoad::busy_threads);
  readings.Gauge("plumescout_pool_queue_depth", "Tasks that wait for a thread of a pool.");
  read(&PoolLoad::queued);
  readings.Gauge("plumescout_pool_queue_limit", "Tasks that may wait for a thread of a pool.");
  read(&PoolLoad::max_queued);
  readings.Counter("plumescout_pool_refused_total",
                   "Tasks refused because a pool's queue was full.");
  read(&PoolLoad::refused);
}

void ReadStore(const ServerState& state, Readings& readings) {
  if (state.store == nullptr) return;
  const StoreState store = state.store->state();
  readings.Gauge("plumescout_store_available", "1 while the store takes data.");
  readings.Add(store.status.ok() ? 1 : 0);
  readings.Gauge("plumescout_store_backlog_bytes", "Data that waits to be durable.");
  readings.Add(store.backlog_bytes);
  readings.Gauge("plumescout_store_backlog_records", "Events that wait to be durable.");
  readings.Add(store.backlog_records);
  readings.Counter("plumescout_store_commits_total", "Commits to disk.");
  readings.Add(store.commits);
  readings.Counter("plumescout_store_slow_commits_total",
                   "Commits that took longer than store.slow_commit_s.");
  readings.Add(store.slow_commits);
  readings.Gauge("plumescout_store_last_commit_seconds", "Duration of the last commit.");
  readings.Add(absl::ToDoubleSeconds(store.last_commit));
  readings.Gauge("plumescout_store_disk_bytes", "Size of all files of the store.");
  readings.Add(state.store_sizes.disk_bytes);
  const AbsentCounts absent = state.missions->absent();
  readings.Gauge("plumescout_missions_recovering", "Missions that are yet to be recovered.");
  readings.Add(absent.recovering);
  readings.Gauge("plumescout_missions_damaged", "Missions that could not be recovered.");
  readings.Add(absent.damaged + state.store_sizes.damaged_missions);
  readings.Gauge("plumescout_missions_sleeping",
                 "Missions that nobody has used for store.sleep_after_s: not in memory.");
  readings.Add(absent.sleeping);
}

void ReadStrays(const ServerState& state, Readings& readings) {
  if (state.store == nullptr) return;
  readings.Counter("plumescout_stray_calls_total",
                   "Calls that named the node that has their mission, and came to this one.");
  readings.Add(state.strays.calls);
  readings.Counter("plumescout_missions_given_up_total",
                   "Missions given up because their calls came to other nodes.");
  readings.Add(state.strays.given_up);
  readings.Gauge("plumescout_node_unreached", "1 for each node that lives and calls do not reach.");
  for (const std::string& node : state.strays.unreached) readings.Add(1, {{"node", node}});
}

using Hosts = std::vector<std::shared_ptr<MissionHost>>;

// Missions of different tenants may have the same name.
Labels LabelsOf(const MissionHost& host) {
  Labels labels = {{"mission", host.id()}};
  if (!host.tenant().empty()) labels.push_back({"tenant", host.tenant()});
  return labels;
}

void ReadMissionCounts(const ServerState& state, Hosts& hosts, Readings& readings) {
  const std::size_t count = hosts.size();
  hosts.resize(std::min(count, static_cast<std::size_t>(state.max_mission_series)));
  readings.Gauge("plumescout_missions", "Missions of the server.");
  readings.Add(count);
  readings.Gauge("plumescout_missions_limit", "Missions that the server may hold.");
  readings.Add(state.max_missions);
  readings.Gauge("plumescout_missions_without_series",
                 "Missions of which there are no series, because there are so many.");
  readings.Add(count - hosts.size());
}

void ReadMissionMemory(const ServerState& state, const Hosts& hosts, Readings& readings) {
  readings.Gauge("plumescout_memory_budget_bytes", "What all missions together may come to hold.");
  readings.Add(state.memory_budget_bytes);
  readings.Gauge("plumescout_memory_reserved_bytes",
                 "What of it is taken: missions are refused by this, not by what they hold.");
  readings.Add(state.missions->reserved_bytes());
  readings.Gauge("plumescout_mission_memory_bytes", "What the mission holds, as it reckons.");
  for (const auto& host : hosts) readings.Add(host->summary().memory_bytes, LabelsOf(*host));
  readings.Gauge("plumescout_mission_memory_budget_bytes", "What the mission may come to hold.");
  for (const auto& host : hosts) {
    readings.Add(host->options().memory_budget_bytes, LabelsOf(*host));
  }
}

void ReadMissionsOnDisk(const ServerState& state, const Hosts& hosts, Readings& readings) {
  if (state.store == nullptr) return;
  readings.Gauge("plumescout_mission_durable_revision", "Events of the mission that are durable.");
  for (const auto& host : hosts) readings.Add(host->journal().durable_revision(), LabelsOf(*host));
  readings.Gauge("plumescout_mission_disk_bytes", "What the store keeps of the mission.");
  const auto& sizes = state.store_sizes.mission_bytes;
  for (const auto& host : hosts) {
    const auto found = sizes.find(MissionKey(host->tenant(), host->id()));
    if (found != sizes.end()) readings.Add(found->second, LabelsOf(*host));
  }
}

void ReadMissions(const ServerState& state, Readings& readings) {
  Hosts hosts = state.missions->List("", state.max_missions);
  ReadMissionCounts(state, hosts, readings);
  ReadMissionMemory(state, hosts, readings);
  ReadMissionsOnDisk(state, hosts, readings);
  std::vector<HostLoad> loads;
  for (const auto& host : hosts) loads.push_back(host->load());
  const auto read = [&](auto HostLoad::*figure) {
    for (std::size_t i = 0; i < hosts.size(); ++i) {
      readings.Add(loads[i].*figure, LabelsOf(*hosts[i]));
    }
  };
  readings.Gauge("plumescout_mission_queued_commands",
                 "Commands that wait for the mission's writer.");
  read(&HostLoad::queued_commands);
  readings.Gauge("plumescout_mission_reserved_observations",
                 "Observations for which there is room reserved in the mission's queue.");
  read(&HostLoad::reserved_observations);
  readings.Gauge("plumescout_mission_waiting_calls",
                 "Calls that wait for a belief of the mission.");
  read(&HostLoad::waiting_calls);
  readings.Gauge("plumescout_mission_watchers", "Open streams that watch the mission's map.");
  read(&HostLoad::watchers);
  readings.Gauge("plumescout_mission_unpublished_seconds",
                 "Time since the acknowledgement of the first reading that watchers do not have.");
  for (std::size_t i = 0; i < hosts.size(); ++i) {
    readings.Add(absl::ToDoubleSeconds(loads[i].unpublished), LabelsOf(*hosts[i]));
  }
  readings.Gauge("plumescout_mission_worst_clock_offset_seconds",
                 "The farthest that the clock of one of its robots is off, either way.");
  for (const auto& host : hosts) {
    readings.Add(absl::ToDoubleSeconds(host->robot_clocks().WorstOffset()), LabelsOf(*host));
  }
  readings.Gauge("plumescout_mission_revision", "Events of the mission.");
  for (const auto& host : hosts) readings.Add(host->summary().revision, LabelsOf(*host));
  readings.Gauge("plumescout_mission_robots", "Robots registered in the mission.");
  for (const auto& host : hosts) {
    readings.Add(host->leases().robot_count(), LabelsOf(*host));
  }
}

}  // namespace

std::string ServerMetrics::Text(const ServerState& state) const {
  std::vector<MetricFamily> families = registry_.Collect();
  Readings readings(families);
  ReadServer(state, readings);
  ReadProcess(readings);
  ReadPools(state, readings);
  ReadStore(state, readings);
  ReadStrays(state, readings);
  ReadMissions(state, readings);
  return prometheus::TextSerializer().Serialize(families);
}

}  // namespace plumescout::server
