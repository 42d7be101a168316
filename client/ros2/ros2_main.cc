// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// plumescout-ros2: puts a robot of ROS 2 into a mission, and says what it would lack for that.

#include <signal.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <atomic>
#include <cstdlib>

#include "client/robot_narrator.h"
#include "client/ros2/check_robot.h"
#include "client/ros2/run_robot.h"

namespace plumescout::client {
namespace {

constexpr char kProgram[] = "plumescout-ros2";

std::atomic<bool> stop_requested = false;

void RequestStop(int) { stop_requested = true; }

struct Flags {
  ListenFlags listen;
  double check_s = 10.0;
  RunFlags run;
};

CLI::App* AddCheck(CLI::App& app, Flags& flags) {
  CLI::App* const check = app.add_subcommand(
      "check",
      "Says what of a robot's topics, transforms and units is missing or does not fit. Ends with 0 "
      "as soon as all is there, with 1 if it is not in time.");
  check->alias("--check");
  check->add_option("--for", flags.check_s, "seconds to listen, at most")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  AddListenFlags(*check, flags.listen);
  return check;
}

CLI::App* AddRun(CLI::App& app, Flags& flags) {
  CLI::App* const run = app.add_subcommand(
      "run", "Puts a robot into a mission of a PlumeScout server, and drives it where that says.");
  AddRobotFlags(*run, flags.run.robot);
  AddListenFlags(*run, flags.run.listen);
  AddTellFlags(*run, flags.run.tell);
  run->add_option("--patience", flags.run.patience_s,
                  "seconds to wait for the robot's place before the mission is joined")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  run->add_option("--arrival-tolerance", flags.run.arrival_tolerance_m,
                  "metres within which a place counts as reached; 0: 0.1 by velocity, else 0.4")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  run->add_flag("--simulated-clock", flags.run.simulated_clock,
                "the robot's stamps do not keep real time (use_sim_time)");
  return run;
}

}  // namespace
}  // namespace plumescout::client

int main(int argc, char** argv) {
  namespace client = plumescout::client;
  signal(SIGPIPE, SIG_IGN);
  signal(SIGINT, client::RequestStop);
  signal(SIGTERM, client::RequestStop);
  CLI::App app("Puts a robot of ROS 2 into a mission, by DDS.", client::kProgram);
  client::Flags flags;
  app.require_subcommand(1);
  app.set_help_all_flag("--help-all", "Print this, and the help of check and run, and exit");
  const CLI::App* const check = client::AddCheck(app, flags);
  client::AddRun(app, flags);
  CLI11_PARSE(app, argc, argv);
  const client::RobotNarrator narrator(client::kProgram);
  absl::Status status;
  if (check->parsed()) {
    const auto complete = client::CheckRobot(
        flags.listen, flags.check_s, [&narrator](const std::string& text) { narrator.Say(text); });
    if (complete.ok()) return *complete ? EXIT_SUCCESS : EXIT_FAILURE;
    status = complete.status();
  } else {
    status = client::RunRobot(
        flags.run, [] { return client::stop_requested.load(); }, client::kProgram);
  }
  if (status.ok()) return EXIT_SUCCESS;
  narrator.Say(status.ToString());
  return EXIT_FAILURE;
}
