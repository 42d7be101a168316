// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// plumescout-ros2: says whether what a robot of ROS 2 publishes is what PlumeScout needs.

#include <signal.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "client/ros2/dds_node.h"
#include "client/ros2/robot_intake.h"
#include "client/ros2/robot_topics.h"
#include "core/types/status_macros.h"

namespace plumescout::client {
namespace {

constexpr absl::Duration kSayAgain = absl::Seconds(5);

struct Flags {
  int domain = 0;
  double seconds = 10.0;
  TopicNames topics;
  IntakeOptions intake;
  std::string gas_calibration;
};

void Say(const std::string& text) { std::fprintf(stderr, "plumescout-ros2: %s\n", text.c_str()); }

void AddFlags(CLI::App& app, Flags& flags) {
  app.add_option("--domain", flags.domain, "domain of DDS")
      ->envname("ROS_DOMAIN_ID")
      ->check(CLI::Range(0, 232))
      ->capture_default_str();
  app.add_option("--for", flags.seconds, "seconds to listen, at most")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--namespace", flags.topics.ros_namespace, "of the robot's topics");
  app.add_option("--scan-topic", flags.topics.scan, "sensor_msgs/LaserScan")->capture_default_str();
  app.add_option("--odom-topic", flags.topics.odometry, "nav_msgs/Odometry")->capture_default_str();
  app.add_option("--tf-topic", flags.topics.tf, "tf2_msgs/TFMessage")->capture_default_str();
  app.add_option("--tf-static-topic", flags.topics.tf_static, "tf2_msgs/TFMessage, latched")
      ->capture_default_str();
  app.add_option("--gas-topic", flags.topics.gas, "olfaction_msgs/GasSensor")
      ->capture_default_str();
  app.add_option("--wind-topic", flags.topics.wind, "olfaction_msgs/Anemometer")
      ->capture_default_str();
  app.add_option("--map-frame", flags.intake.map_frame)->capture_default_str();
  app.add_option("--odom-frame", flags.intake.odom_frame)->capture_default_str();
  app.add_option("--base-frame", flags.intake.base_frame)->capture_default_str();
  app.add_option("--gas-calibration", flags.gas_calibration,
                 "SCALE,EXPONENT: what is measured in VOLT or OHM is SCALE * raw ^ EXPONENT ppm");
}

// Tells of the same thing every five seconds at most.
class Complaints {
 public:
  void Add(const std::string& about, const std::string& what) {
    absl::Time& said = said_[about];
    if (absl::Now() - said < kSayAgain) return;
    said = absl::Now();
    Say(absl::StrCat(about, ": ", what));
  }

 private:
  std::map<std::string, absl::Time> said_;  // by topic, of which there are few
};

std::vector<std::string> WhatIsMissing(const DdsNode& node, const RobotIntake& intake) {
  std::vector<std::string> missing;
  if (const auto pose = intake.LatestPose(); !pose.ok()) {
    missing.emplace_back(pose.status().message());
  }
  if (intake.counters().scans == 0) missing.emplace_back("no scan that could be placed");
  if (intake.counters().gas_readings == 0) {
    missing.emplace_back("no gas reading that could be placed");
  }
  if (missing.empty()) return missing;
  if (const absl::Status waiting = intake.Waiting(); !waiting.ok()) {
    missing.emplace_back(waiting.message());
  }
  for (const DdsNode::Source& source : node.Sources()) {
    if (source.publishers == 0) missing.push_back(absl::StrCat("nobody publishes ", source.topic));
  }
  return missing;
}

// Whether everything is there.
absl::StatusOr<bool> Check(Flags flags) {
  if (!flags.gas_calibration.empty()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(flags.intake.gas_calibration,
                                ReadCalibration(flags.gas_calibration));
  }
  Complaints complaints;
  RobotIntake intake(flags.intake, [&](const std::string& about, const absl::Status& why) {
    complaints.Add(about, std::string(why.message()));
  });
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::unique_ptr<DdsNode> node, DdsNode::Open(flags.domain));
  PLUMESCOUT_RETURN_IF_ERROR(ListenToRobot(flags.topics, *node, intake));
  const absl::Time begin = absl::Now();
  const absl::Time end = begin + absl::Seconds(flags.seconds);
  std::vector<std::string> missing = {"everything"};
  while (!missing.empty() && absl::Now() < end) {
    node->Poll(absl::Milliseconds(100));
    const std::int64_t steady_ns = absl::ToInt64Nanoseconds(
        absl::FromChrono(std::chrono::steady_clock::now().time_since_epoch()));
    while (intake.TakeScan(steady_ns)) continue;
    while (intake.TakeGas(steady_ns)) continue;
    for (const std::string& misfit : node->TakeMisfits()) Say(misfit);
    missing = WhatIsMissing(*node, intake);
    // DDS takes a while to find others.
    if (absl::Now() - begin < kSayAgain) continue;
    for (const std::string& what : missing) complaints.Add("waiting", what);
  }
  for (const std::string& what : missing) Say(absl::StrCat("missing: ", what));
  const IntakeCounters& counters = intake.counters();
  Say(absl::StrCat("heard ", counters.scans, " scans, ", counters.gas_readings, " gas readings, ",
                   counters.winds, " of wind; refused ", counters.bad, ", without a place ",
                   counters.unplaced));
  return missing.empty();
}

}  // namespace
}  // namespace plumescout::client

int main(int argc, char** argv) {
  namespace client = plumescout::client;
  CLI::App app(
      "Listens to a robot of ROS 2 by DDS and says what of its topics, transforms and units is "
      "missing or does not fit. Ends with 0 as soon as all is there, with 1 if it is not in time.",
      "plumescout-ros2");
  client::Flags flags;
  app.require_subcommand(1);
  client::AddFlags(*app.add_subcommand("check", "says what is missing, and ends"), flags);
  CLI11_PARSE(app, argc, argv);
  const absl::StatusOr<bool> complete = client::Check(flags);
  if (!complete.ok()) client::Say(complete.status().ToString());
  return complete.ok() && *complete ? EXIT_SUCCESS : EXIT_FAILURE;
}
