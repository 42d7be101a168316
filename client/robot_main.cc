// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// plumescout-robot: puts any robot program that speaks lines of JSON into a mission.

#include <signal.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/time/time.h"
#include "client/credentials.h"
#include "client/grpc_planner_client.h"
#include "client/line_driver.h"
#include "client/robot_loop.h"
#include "client/sensor_arguments.h"
#include "core/types/prior_map.h"
#include "core/types/status_macros.h"
#include "formats/map_server.h"

namespace plumescout::client {
namespace {

constexpr char kDescription[] =
    R"(Puts a robot into a mission of a PlumeScout server.

The robot is any program at the other end of standard input and output. It writes one JSON object a
line, in its own frame, metres and radians, with the time of its own clock:
  {"type":"pose","time_ns":0,"x_m":0,"y_m":0,"yaw_rad":0}
  {"type":"scan","time_ns":0,"start_angle_rad":-3.14,"angle_step_rad":0.0175,"max_range_m":8,
   "ranges_m":[1.5,null,8]}          (null: beam unknown; max_range_m or more: nothing was hit)
  {"type":"gas","time_ns":0,"concentration_ppm":3.2,"stddev_ppm":0.1}       (stddev_ppm: optional)
  {"type":"correction","time_ns":0,"pose":{..},"anchors":[{"time_ns":0,"x_m":0,"y_m":0,"yaw_rad":0}]}
                                     (poses of before were wrong; that of this line is right)
Scans and gas readings may carry "pose":{"x_m":..,"y_m":..,"yaw_rad":..}, the pose at which they were
taken; otherwise the latest pose counts. Each object is one line. It reads velocities to hold:
  {"type":"twist","forward_mps":0.2,"turn_rad_per_s":-0.1}
Time passes as the lines say: send poses at 10 Hz or more. Messages for people go to standard error.)";

std::atomic<bool> stop_requested = false;

void RequestStop(int) { stop_requested = true; }

// Says on standard error what happens.
class Narrator final : public RobotObserver {
 public:
  void OnPlan(const PlanArrival& arrival) override {
    Say(absl::StrCat("plan ", arrival.plan.id, " at ", arrival.elapsed_s,
                     " s: ", arrival.plan.explanation));
  }
  void OnReport(PlanId plan, ProgressOutcome outcome) override {
    const char* what = outcome == ProgressOutcome::kReached   ? "reached"
                       : outcome == ProgressOutcome::kBlocked ? "blocked"
                                                              : "given up";
    Say(absl::StrCat("plan ", plan, ": ", what));
  }
  void OnPlanFailure(const absl::Status& status) override {
    Say(absl::StrCat("no plan: ", status.ToString()));
  }
  void OnRejected(const ObservationRejected& rejected) override {
    Say(absl::StrCat("observation ", rejected.sequence, " refused: ", rejected.status.ToString()));
  }
  void OnLink(const absl::Status& status) override {
    Say(status.ok() ? "link is up" : absl::StrCat("link: ", status.ToString()));
  }

  void OnRolledBack(std::int64_t applied_sequence, std::int64_t forgotten) override {
    Say(absl::StrCat("the server was set back: it has ", applied_sequence,
                     " observations of this robot, although it had more; the rest is sent again",
                     forgotten > 0 ? absl::StrCat(", but for ", forgotten, " that are gone") : ""));
  }
  void OnDisk(const absl::Status& status) override {
    Say(status.ok() ? "the log is written to disk again"
                    : absl::StrCat("log on disk: ", status.message()));
  }

  static void Say(const std::string& text) {
    std::fprintf(stderr, "plumescout-robot: %s\n", text.c_str());
  }
};

struct Flags {
  GrpcClientOptions client;
  RobotLoopOptions loop;
  bool create_mission = false;
  std::string prior_map;  // empty: none
  std::vector<std::string> gas_sensors;
  double log_sync_period_s = absl::ToDoubleSeconds(LogStoreOptions().sync_period);
};

void AddCredentials(CLI::App& app, Credentials& credentials) {
  app.add_option("--tls-ca", credentials.tls_ca_file,
                 "PEM file of the authorities of the server's certificate: speak TLS")
      ->envname("PLUMESCOUT_TLS_CA");
  app.add_option("--tls-cert", credentials.tls_certificate_file,
                 "PEM file of this client's certificate, which says who it is")
      ->envname("PLUMESCOUT_TLS_CERT");
  app.add_option("--tls-key", credentials.tls_key_file, "PEM file of its private key")
      ->envname("PLUMESCOUT_TLS_KEY");
  app.add_option("--token-file", credentials.token_file,
                 "file with the bearer token that says who this client is")
      ->envname("PLUMESCOUT_TOKEN_FILE");
}

void AddOutfit(CLI::App& app, Participation& participation, std::vector<std::string>& gas_sensors) {
  RobotFrame& frame = participation.frame;
  app.add_option("--frame-x", frame.mission_from_robot.x_m,
                 "where the origin of this robot's frame lies in the mission's, metres east")
      ->capture_default_str();
  app.add_option("--frame-y", frame.mission_from_robot.y_m, "likewise, metres north")
      ->capture_default_str();
  app.add_option("--frame-yaw", frame.mission_from_robot.yaw_rad,
                 "by how much its frame is turned against the mission's, radians")
      ->capture_default_str();
  app.add_option("--frame-position-stddev", frame.position_stddev_m,
                 "standard deviation of where it lies, metres: others keep so much farther off")
      ->capture_default_str();
  app.add_option("--frame-heading-stddev", frame.heading_stddev_rad,
                 "standard deviation of its heading, radians")
      ->capture_default_str();
  app.add_option(
      "--gas-sensor", gas_sensors,
      "a gas sensor as ID,AHEAD,LEFT,STDDEV,OFFSET_STDDEV,SPECIES,RESPONSE_TIME: where it sits, "
      "metres, the standard deviations of its noise and its unknown offset, ppm (0: the mission's "
      "model; calibrated), which of the mission's gases it reads (left out: the first), and its "
      "lag, seconds, if the mission is to undo it; once for each, in the order in which readings "
      "name them");
}

void AddFlags(CLI::App& app, Flags& flags) {
  Participation& participation = flags.loop.participation;
  app.add_option("--server", flags.client.target, "host:port of the server")->capture_default_str();
  app.add_option("--mission", participation.mission, "name of the mission")->required();
  app.add_option("--robot", participation.robot, "name of this robot in the mission")->required();
  app.add_flag("--create-mission", flags.create_mission,
               "create the mission if it is not there, with the server's options");
  app.add_option("--prior-map", flags.prior_map,
                 "YAML file of a map_server map: create the mission, if it is not there, with this "
                 "as what is known of the building")
      ->check(CLI::ExistingFile);
  app.add_flag("--take-over", participation.take_over,
               "supersede another client that writes as this robot");
  app.add_option("--radius", participation.radius_m, "radius of the robot's footprint, metres")
      ->capture_default_str();
  AddOutfit(app, participation, flags.gas_sensors);
  app.add_option("--max-speed", flags.loop.follower.max_forward_mps,
                 "greatest speed, metres a second; plans may ask for less")
      ->capture_default_str();
  app.add_option("--max-turn", flags.loop.follower.max_turn_rad_per_s,
                 "greatest turn rate, radians a second")
      ->capture_default_str();
  app.add_option("--gas-time-constant", flags.loop.gas_sampling.time_constant_s,
                 "lag of the gas sensor (first order), seconds, undone before sending; 0: none")
      ->capture_default_str();
  app.add_option("--gas-settling", flags.loop.gas_sampling.settling_s,
                 "seconds that the robot has to stand before gas readings count, for a slow sensor "
                 "and a mission with a dwell time; 0: they always count")
      ->capture_default_str();
  app.add_option("--time-limit", flags.loop.time_limit_s,
                 "end after so many seconds of the robot's clock; 0: never")
      ->capture_default_str();
  app.add_option("--log-dir", flags.loop.ingest.store.folder,
                 "folder in which observations are kept until the server has them on disk, so that "
                 "none is lost when the robot's computer, the server, or both restart; one for "
                 "each robot and mission");
  app.add_option("--log-sync-period", flags.log_sync_period_s,
                 "seconds of observations that a loss of power may take from that folder; 0: sync "
                 "each, inf: sync at the end alone")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
}

// An epoch for a log that begins now: 53 random bits, but not 0.
std::int64_t DrawLogEpoch() {
  constexpr int kLogEpoch_bits = 53;
  static_assert(std::int64_t{1} << kLogEpoch_bits == kLogEpochEnd);
  std::random_device device;
  const std::uint64_t bits = std::uint64_t{device()} << 32 | device();
  return std::max<std::int64_t>(static_cast<std::int64_t>(bits >> (64 - kLogEpoch_bits)), 1);
}

absl::Status RunRobot(Flags flags) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckCredentials(flags.client.credentials));
  if (flags.create_mission) flags.loop.participation.create = MissionOptions{};
  if (!flags.prior_map.empty()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(Grid<CellState> map, ReadMapServer(flags.prior_map));
    MissionOptions& mission = flags.loop.participation.create.emplace();
    StartWith(std::make_shared<const Grid<CellState>>(std::move(map)), mission);
    PLUMESCOUT_RETURN_IF_ERROR(Validate(mission));
  }
  flags.loop.ingest.store.sync_period = absl::Seconds(flags.log_sync_period_s);
  PLUMESCOUT_ASSIGN_OR_RETURN(flags.loop.participation.sensors, ReadSensors(flags.gas_sensors));
  flags.loop.new_log_epoch = DrawLogEpoch();
  flags.loop.real_clock = true;
  LineDriver driver({.on_bad_line = [](const absl::Status& status) {
    Narrator::Say(absl::StrCat("bad line: ", status.message()));
  }});
  PLUMESCOUT_RETURN_IF_ERROR(driver.AwaitPose());
  const auto client = MakeGrpcPlannerClient(flags.client);
  Narrator narrator;
  RobotLoop loop(*client, driver, flags.loop, narrator);
  const auto result = loop.Run([] { return stop_requested.load(); });
  if (!result.ok()) return result.status();
  Narrator::Say(absl::StrCat("done after ", result->elapsed_s, " s: ", result->plans, " plans, ",
                             result->distance_m, " m, ", result->ingest.applied_sequence, " of ",
                             result->ingest.last_sequence, " observations applied, ",
                             result->ingest.durable_sequence, " durable"));
  return absl::OkStatus();
}

}  // namespace
}  // namespace plumescout::client

int main(int argc, char** argv) {
  namespace client = plumescout::client;
  signal(SIGPIPE, SIG_IGN);
  signal(SIGINT, client::RequestStop);
  signal(SIGTERM, client::RequestStop);
  CLI::App app(client::kDescription, "plumescout-robot");
  client::Flags flags;
  client::AddFlags(app, flags);
  client::AddCredentials(app, flags.client.credentials);
  CLI11_PARSE(app, argc, argv);
  const absl::Status status = client::RunRobot(flags);
  if (status.ok()) return EXIT_SUCCESS;
  client::Narrator::Say(status.ToString());
  return EXIT_FAILURE;
}
