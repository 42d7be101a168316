// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// plumescout-robot: puts any robot program that speaks lines of JSON into a mission.

#include <signal.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <atomic>
#include <cstdlib>
#include <optional>

#include "absl/strings/str_cat.h"
#include "client/grpc_planner_client.h"
#include "client/line_driver.h"
#include "client/robot_flags.h"
#include "client/robot_loop.h"
#include "client/robot_narrator.h"
#include "client/robot_recorder.h"
#include "core/types/status_macros.h"

namespace plumescout::client {
namespace {

constexpr char kProgram[] = "plumescout-robot";
constexpr char kDescription[] =
    R"(Puts a robot into a mission of a PlumeScout server.

The robot is any program at the other end of standard input and output. It writes one JSON object a
line, in its own frame, metres and radians, with the time of its own clock:
  {"type":"pose","time_ns":0,"x_m":0,"y_m":0,"yaw_rad":0}
  {"type":"scan","time_ns":0,"start_angle_rad":-3.14,"angle_step_rad":0.0175,"max_range_m":8,
   "ranges_m":[1.5,null,8]}          (null: beam unknown; max_range_m or more: nothing was hit)
  {"type":"gas","time_ns":0,"concentration_ppm":3.2,"stddev_ppm":0.1,"sensor":0}
                                     (stddev_ppm and sensor, which one of --gas-sensor: optional)
  {"type":"status","time_ns":0,"battery_share":0.8}
  {"type":"correction","time_ns":0,"pose":{..},"anchors":[{"time_ns":0,"x_m":0,"y_m":0,"yaw_rad":0}]}
                                     (poses of before were wrong; that of this line is right)
Scans and gas readings may carry "pose":{"x_m":..,"y_m":..,"yaw_rad":..}, the pose at which they were
taken; otherwise the latest pose counts. Each object is one line. It reads velocities to hold:
  {"type":"twist","forward_mps":0.2,"turn_rad_per_s":-0.1}
Time passes as the lines say: send poses at 10 Hz or more. Messages for people go to standard error.)";

std::atomic<bool> stop_requested = false;

void RequestStop(int) { stop_requested = true; }

absl::Status RunRobot(RobotFlags flags) {
  PLUMESCOUT_RETURN_IF_ERROR(Prepare(flags));
  std::optional<RobotRecorder> recorder;
  RobotNarrator narrator(kProgram, [&recorder](bool is_warning, const std::string& line) {
    if (recorder) recorder->OnSaid(is_warning, line);
  });
  LineDriver driver({.on_bad_line = [&narrator](const absl::Status& status) {
    narrator.Say(absl::StrCat("bad line: ", status.message()));
  }});
  PLUMESCOUT_RETURN_IF_ERROR(driver.AwaitPose());
  const auto client = MakeGrpcPlannerClient(flags.client);
  RobotObserver* observer = &narrator;
  if (!flags.record_folder.empty()) {
    observer = &recorder.emplace(RecordingOf(flags, kProgram), flags.loop.participation,
                                 driver.now_ns(), &narrator);
  }
  RobotLoop loop(*client, driver, flags.loop, *observer);
  const auto result = loop.Run([] { return stop_requested.load(); });
  if (!result.ok()) return result.status();
  narrator.SayResult(*result);
  return absl::OkStatus();
}

}  // namespace
}  // namespace plumescout::client

int main(int argc, char** argv) {
  namespace client = plumescout::client;
  signal(SIGPIPE, SIG_IGN);
  signal(SIGINT, client::RequestStop);
  signal(SIGTERM, client::RequestStop);
  CLI::App app(client::kDescription, client::kProgram);
  client::RobotFlags flags;
  client::AddRobotFlags(app, flags);
  CLI11_PARSE(app, argc, argv);
  const absl::Status status = client::RunRobot(flags);
  if (status.ok()) return EXIT_SUCCESS;
  client::RobotNarrator(client::kProgram).Say(status.ToString());
  return EXIT_FAILURE;
}
