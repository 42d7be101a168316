// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// plumescout-ros2-peer: a simulated robot that speaks ROS 2 by Fast DDS, on loopback alone.

#include <signal.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "absl/time/clock.h"
#include "lab/formats/scene_folder.h"
#include "lab/sim/scene_world.h"
#include "tests/e2e/gas_hall.h"
#include "tests/ros2_peer/peer_robot.h"

namespace plumescout::ros2_peer {
namespace {

std::atomic<bool> stop_requested = false;

void RequestStop(int) { stop_requested = true; }

struct Flags {
  PeerOptions peer;
  std::string scene;
  double report_period_s = 1.0;
};

// One line of JSON.
void Print(const PeerReport& report, const Pose2& pose) {
  double median_s = 0.0;
  if (std::vector<double> sorted = report.latencies_s; !sorted.empty()) {
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<long>(sorted.size() / 2),
                     sorted.end());
    median_s = sorted[sorted.size() / 2];
  }
  std::printf(
      "{\"driven_m\":%.3f,\"x_m\":%.3f,\"y_m\":%.3f,\"paths\":%lld,\"velocities\":%lld,"
      "\"maps\":%lld,\"gas_maps\":%lld,\"gas_layers\":%lld,\"frontiers\":%lld,\"unreadable\":%lld,"
      "\"path_latency_median_s\":%.4f}\n",
      report.driven_m, pose.x_m, pose.y_m, static_cast<long long>(report.paths),
      static_cast<long long>(report.velocities), static_cast<long long>(report.maps),
      static_cast<long long>(report.gas_maps), static_cast<long long>(report.gas_layers),
      static_cast<long long>(report.frontiers), static_cast<long long>(report.unreadable),
      median_s);
  std::fflush(stdout);
}

int Run(const Flags& flags) {
  auto scene = flags.scene.empty() ? lab::MakeGasHall() : lab::ReadScene(flags.scene);
  if (!scene.ok()) {
    std::fprintf(stderr, "%s\n", scene.status().ToString().c_str());
    return EXIT_FAILURE;
  }
  const lab::SceneWorld world(*std::move(scene));
  lab::SimulatedRobotOptions options;
  options.realtime = true;
  options.start_time_ns = absl::GetCurrentTimeNanos();
  options.max_forward_mps = 0.6;
  options.lidar.beams = flags.peer.beams;
  auto robot = lab::SimulatedRobot::Create(world, options);
  if (!robot.ok()) {
    std::fprintf(stderr, "%s\n", robot.status().ToString().c_str());
    return EXIT_FAILURE;
  }
  PeerRobot peer(*robot, flags.peer);
  double reported_s = 0.0;
  while (!stop_requested) {
    peer.Step();
    if (robot->elapsed_s() - reported_s < flags.report_period_s) continue;
    reported_s = robot->elapsed_s();
    Print(peer.report(), robot->true_pose());
  }
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace plumescout::ros2_peer

int main(int argc, char** argv) {
  namespace peer = plumescout::ros2_peer;
  signal(SIGINT, peer::RequestStop);
  signal(SIGTERM, peer::RequestStop);
  CLI::App app("A simulated robot that speaks ROS 2 by Fast DDS, on loopback alone.",
               "plumescout-ros2-peer");
  peer::Flags flags;
  app.add_option("--domain", flags.peer.domain)->envname("ROS_DOMAIN_ID");
  app.add_option("--namespace", flags.peer.ros_namespace);
  app.add_option("--scene", flags.scene, "folder; none: a small hall");
  app.add_flag("--by-path", flags.peer.drives_by_path, "follows the path, not velocities");
  app.add_flag("--mischief", flags.peer.makes_mischief, "publishes what makes no sense, besides");
  app.add_option("--slam-jump", flags.peer.slam_jump_s,
                 "seconds after which SLAM finds out that it was off; 0: it never was");
  app.add_option("--beams", flags.peer.beams);
  app.add_option("--report-period", flags.report_period_s, "seconds between lines of JSON");
  CLI11_PARSE(app, argc, argv);
  return peer::Run(flags);
}
