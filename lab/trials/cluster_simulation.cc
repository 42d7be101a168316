// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/cluster_simulation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <queue>

#include "core/types/rng.h"

namespace plumescout::lab {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kBackoffFactor = 1.6;
constexpr double kJitter = 0.2;

struct Mission {
  std::size_t node = 0;         // that the router sends its calls to
  double asked_until_s = -1.0;  // an answer that the node has, or waits for
  double served_from_s = kNever;
  double recovery_s = 0.0;
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
        free_from_s_(static_cast<std::size_t>(model.nodes - 1), 0.0),
        missions_(static_cast<std::size_t>(model.missions)),
        robots_(missions_.size() * static_cast<std::size_t>(model.robots)) {
    // Recovering takes one core at most, and what the others' missions leave.
    const double share = std::min(1.0, model_.cores * (1.0 - model_.utilisation));
    for (Mission& mission : missions_) {
      mission.node = rng_.Below(free_from_s_.size());
      const double tail = rng_.Uniform(0.0, model_.largest_tail);
      mission.recovery_s = (model_.read_s + tail * model_.replay_s) / share;
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
      Mission& mission = missions_[robots_[attempt.robot].mission];
      if (attempt.time_s >= mission.served_from_s) {
        waits_s[attempt.robot] = attempt.time_s;
        continue;
      }
      attempts_.push({attempt.time_s + Refuse(mission, attempt), attempt.robot});
    }
    return waits_s;
  }

 private:
  // How long the robot waits before its next attempt.
  double Refuse(Mission& mission, const Attempt& attempt) {
    const bool is_taken = mission.served_from_s != kNever;
    if (is_taken) return model_.retry_recovering_s;
    if (attempt.time_s < mission.asked_until_s) return NextBackoff_s(robots_[attempt.robot]);
    const double answered_s = attempt.time_s + model_.store_s;
    if (answered_s >= lease_end_s_) {
      double& free_from_s = free_from_s_[mission.node];
      free_from_s = std::max(free_from_s, answered_s) + mission.recovery_s;
      mission.served_from_s = free_from_s;
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
  std::vector<double> free_from_s_;  // by node: one mission is recovered at a time
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
