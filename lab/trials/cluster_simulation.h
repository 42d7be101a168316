// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace plumescout::lab {

// Servers that share a store, one of which has died, as a discrete-event simulation: what robots
// wait for is simulated, event by event; what the service computes is a duration that was measured.
struct ClusterModel {
  int nodes = 3;             // before one of them died; >= 2
  double cores = 2.0;        // of a node; > 0
  double utilisation = 0.5;  // of the cores, by missions that run; [0, 1)
  int recoveries = 2;        // of a node at a time (store.recovery_threads), a core each; >= 1
  int missions = 50;         // of the node that died
  int robots = 4;            // of a mission

  double lease_s = 1.0;         // renewed four times in it
  double noticed_s = 0.0;       // from the end of the node until its calls end: a node that hangs
  double store_s = 0.01;        // a question to the store
  double answer_holds_s = 0.5;  // what the store has said of a mission, at a node
  double retry_recovering_s = 0.5;  // callers of RECOVERING
  double first_backoff_s = 0.1;     // of other calls that failed; 1.6 times as long each, +- 20 %
  double longest_backoff_s = 2.0;

  double read_s = 0.012;         // CPU time to read a mission's snapshot
  double replay_s = 0.00055;     // CPU time of an event of its tail
  double largest_tail = 3600.0;  // events; what a mission has is uniform below
};

// How long each robot of the node was not served. Same model and seed, same waits.
std::vector<double> FailoverWaits_s(const ClusterModel& model, std::uint64_t seed);

// A mission has one writer, for which what its robots send waits; arrivals are random.
struct HotMission {
  int robots = 8;
  double events_per_s = 12.0;  // of a robot
  double event_s = 0.00078;    // of the writer
  double duration_s = 60.0;
};

// From an event's arrival until it is applied, of all events. Of a writer that cannot keep up they
// grow with the duration.
std::vector<double> WriterWaits_s(const HotMission& mission, std::uint64_t seed);

}  // namespace plumescout::lab
