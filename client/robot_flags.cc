// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/robot_flags.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cstdint>
#include <memory>
#include <random>
#include <utility>

#include "absl/time/time.h"
#include "client/credentials.h"
#include "client/robot_narrator.h"
#include "client/sensor_arguments.h"
#include "core/types/prior_map.h"
#include "core/types/status_macros.h"
#include "formats/map_server.h"

namespace plumescout::client {
namespace {

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

void AddParticipation(CLI::App& app, RobotFlags& flags) {
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
}

void AddConduct(CLI::App& app, RobotFlags& flags) {
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
  app.add_option(
      "--replan-period", flags.loop.replan_period_s,
      "on its way, ask for a better plan so many seconds after the last began, and go on "
      "meanwhile; 0: when it is there; default: as plans advise");
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
  app.add_option("--record", flags.record_folder,
                 "folder in which the run is recorded as MCAP files, MISSION/ROBOT.TIME.mcap: what "
                 "is sent, what comes back, and what viewers draw of it");
}

// An epoch for a log that begins now: 53 random bits, but not 0.
std::int64_t DrawLogEpoch() {
  constexpr int kLogEpoch_bits = 53;
  static_assert(std::int64_t{1} << kLogEpoch_bits == kLogEpochEnd);
  std::random_device device;
  const std::uint64_t bits = std::uint64_t{device()} << 32 | device();
  return std::max<std::int64_t>(static_cast<std::int64_t>(bits >> (64 - kLogEpoch_bits)), 1);
}

}  // namespace

void AddRobotFlags(CLI::App& app, RobotFlags& flags) {
  AddParticipation(app, flags);
  AddConduct(app, flags);
  AddCredentials(app, flags.client.credentials);
}

absl::Status Prepare(RobotFlags& flags) {
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
  return absl::OkStatus();
}

RobotRecordingOptions RecordingOf(const RobotFlags& flags, const std::string& program) {
  return {.folder = flags.record_folder,
          .file = {},
          .say = [aside = RobotNarrator(program)](const std::string& text) { aside.Say(text); }};
}

}  // namespace plumescout::client
