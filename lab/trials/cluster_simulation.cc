// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/cluster_simulation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <queue>
#include <span>

#include "core/types/rng.h"

namespace plumescout::lab {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kBackoffFactor = 1.6;
constexpr double kJitter = 0.2;
constexpr double kDone_s = 1e-9;

struct Mission {
  std::size_t node = 0;         // that the router sends its calls to
  double asked_until_s = -1.0;  // an answer that the node has, or waits for
  bool is_taken = false;
  double left_s = 0.0;            // of its recovery, on a core of its own
  double served_from_s = kNever;  // once its node has come so far
};

struct Node {
  double time_s = 0.0;             // up to which it has recovered
  std::vector<std::size_t> taken;  // missions that are left, in the order in which it took them
};

struct Robot {
  std::size_t mission = 0;
  double backoff_s = 0.0;
};

struct Attempt {
  double time_s = 0.0;
  std::size_t robot = 0;

  bool operator<(const Attempt& other) const {  // the earliest is on top of a queue
    return time_s != other.time_s ? time_s > other.time_s : robot > other.robot;
  }
};

class Failover {
 public:
  Failover(const ClusterModel& model, std::uint64_t seed)
      : model_(model),
        rng_(seed),
        // The last renewal was a quarter of the lease ago at most.
        lease_end_s_(model.lease_s * rng_.Uniform(0.75, 1.0)),
        nodes_(static_cast<std::size_t>(model.nodes - 1)),
        missions_(static_cast<std::size_t>(model.missions)),
        robots_(missions_.size() * static_cast<std::size_t>(model.robots)) {
    for (Mission& mission : missions_) {
      mission.node = rng_.Below(nodes_.size());
      const double tail = rng_.Uniform(0.0, model_.largest_tail);
      mission.left_s = model_.store_s + model_.read_s + tail * model_.replay_s;
    }
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      robots_[i] = {i % missions_.size(), model_.first_backoff_s};
      attempts_.push({model_.noticed_s + rng_.Uniform(0.0, model_.first_backoff_s), i});
    }
  }

  std::vector<double> Run() {
    std::vector<double> waits_s(robots_.size(), 0.0);
    while (!attempts_.empty()) {
      const Attempt attempt = attempts_.top();
      attempts_.pop();
      const std::size_t index = robots_[attempt.robot].mission;
      const Mission& mission = missions_[index];
      Advance(nodes_[mission.node], attempt.time_s);
      if (attempt.time_s >= mission.served_from_s) {
        waits_s[attempt.robot] = attempt.time_s;
        continue;
      }
      attempts_.push({attempt.time_s + Refuse(index, attempt), attempt.robot});
    }
    return waits_s;
  }

 private:
  // Those that it recovers at a time share what its other missions leave of its cores.
  void Advance(Node& node, double until_s) {
    const double free_cores = model_.cores * (1.0 - model_.utilisation);
    while (!node.taken.empty() && node.time_s < until_s) {
      const std::span<const std::size_t> begun =
          std::span(node.taken)
              .first(std::min(node.taken.size(), static_cast<std::size_t>(model_.recoveries)));
      const double rate = std::min(1.0, free_cores / static_cast<double>(begun.size()));
      double step_s = until_s - node.time_s;
      for (const std::size_t i : begun) step_s = std::min(step_s, missions_[i].left_s / rate);
      for (const std::size_t i : begun) missions_[i].left_s -= step_s * rate;
      node.time_s += step_s;
      std::erase_if(node.taken, [&](std::size_t i) {
        if (missions_[i].left_s > kDone_s) return false;
        missions_[i].served_from_s = node.time_s;
        return true;
      });
    }
    node.time_s = until_s;
  }

  // How long the robot waits before its next attempt.
  double Refuse(std::size_t index, const Attempt& attempt) {
    Mission& mission = missions_[index];
    if (mission.is_taken) return model_.retry_recovering_s;
    if (attempt.time_s < mission.asked_until_s) return NextBackoff_s(robots_[attempt.robot]);
    const double answered_s = attempt.time_s + model_.store_s;
    if (answered_s >= lease_end_s_) {
      mission.is_taken = true;
      nodes_[mission.node].taken.push_back(index);
    } else {
      mission.asked_until_s = answered_s + model_.answer_holds_s;
    }
    return model_.retry_recovering_s;  // that is what who makes a node ask is told
  }

  double NextBackoff_s(Robot& robot) {
    const double wait_s = robot.backoff_s * rng_.Uniform(1.0 - kJitter, 1.0 + kJitter);
    robot.backoff_s = std::min(robot.backoff_s * kBackoffFactor, model_.longest_backoff_s);
    return wait_s;
  }

  const ClusterModel model_;
  Rng rng_;
  const double lease_end_s_;
  std::vector<Node> nodes_;  // that are left
  std::vector<Mission> missions_;
  std::vector<Robot> robots_;
  std::priority_queue<Attempt> attempts_;
};

}  // namespace

std::vector<double> FailoverWaits_s(const ClusterModel& model, std::uint64_t seed) {
  return Failover(model, seed).Run();
}

std::vector<double> WriterWaits_s(const HotMission& mission, std::uint64_t seed) {
  Rng rng(seed);
  const double arrivals_per_s = mission.robots * mission.events_per_s;
  std::vector<double> waits_s;
  double free_from_s = 0.0;
  for (double time_s = 0.0; time_s < mission.duration_s;) {
    time_s -= std::log(1.0 - rng.Uniform01()) / arrivals_per_s;
    free_from_s = std::max(free_from_s, time_s) + mission.event_s;
    waits_s.push_back(free_from_s - time_s);
  }
  return waits_s;
}

}  // namespace plumescout::lab
