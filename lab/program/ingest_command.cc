// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/ingest_command.h"

#include <cstdint>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "core/types/status_macros.h"
#include "lab/bags/bag_intake.h"
#include "lab/bags/bag_reader.h"
#include "lab/local/local_planner_client.h"
#include "lab/program/progress_line.h"
#include "lab/program/recording.h"
#include "lab/program/robot_run.h"
#include "lab/program/run_folder.h"

namespace plumescout::lab {
namespace {

constexpr char kIngestedMission[] = "ingested";

struct IngestArguments {
  std::string bag;
  std::string record;
  std::string out = "out/ingest";
  std::string robot = "robot";
  double radius_m = 0.2;
  BagTopics topics;
  client::IntakeOptions intake;
  std::string gas_calibration;
};

// A mission in this process, whose events are recorded, and the one robot in it.
class RecordedMission {
 public:
  RecordedMission(Recorder& recorder)
      : planner_({.on_event = [&recorder](const Event& event) { recorder.Record(event); }}) {}

  absl::Status Begin(const RobotId& robot, double radius_m,
                     const client::RobotOutfit& outfit = {}) {
    PLUMESCOUT_RETURN_IF_ERROR(planner_.CreateMission(kIngestedMission, MissionOptions()));
    PLUMESCOUT_ASSIGN_OR_RETURN(
        const client::RobotSession session,
        planner_.RegisterRobot(kIngestedMission, robot, radius_m, false, 0, outfit));
    PLUMESCOUT_ASSIGN_OR_RETURN(stream_, planner_.OpenObservationStream(session));
    return absl::OkStatus();
  }
  absl::Status Add(std::int64_t sample_time_ns, const Pose2& pose, ObservationPayload payload) {
    PLUMESCOUT_RETURN_IF_ERROR(
        stream_->Write({{++sequence_, sample_time_ns, pose, std::move(payload)}}));
    for (auto reply = stream_->Read(absl::ZeroDuration()); reply.ok();
         reply = stream_->Read(absl::ZeroDuration())) {
      const auto* const refused = std::get_if<client::ObservationRejected>(&*reply);
      if (refused == nullptr) continue;
      if (refused_++ == 0) first_refusal_ = refused->status;
    }
    return absl::OkStatus();
  }
  void TellRefusals() const {
    if (refused_ == 0) return;
    std::cerr << "the mission refused " << refused_ << ", first for: " << first_refusal_.message()
              << "\n";
  }
  absl::StatusOr<MapSnapshot> Map() { return planner_.GetMap(kIngestedMission); }

 private:
  LocalPlannerClient planner_;
  std::unique_ptr<client::ObservationStream> stream_;  // does not outlive the planner
  std::int64_t sequence_ = 0;
  std::int64_t refused_ = 0;
  absl::Status first_refusal_;
};

void TellEnd(const std::string& torn_end) {
  if (!torn_end.empty()) std::cerr << torn_end << "; what stands before is kept\n";
}

// What went wrong, by topic: the first time it did, and how often.
class Troubles {
 public:
  void Add(const std::string& about, const absl::Status& why) {
    auto& [count, first] = by_topic_[about];
    if (count++ == 0) first = std::string(why.message());
  }
  void Tell(const BagReader& bag) const {
    for (const auto& [about, trouble] : by_topic_) {
      std::cerr << about << ": passed over " << trouble.first << ", first for: " << trouble.second
                << "\n";
    }
    for (const auto& [encoding, count] : bag.unknown_encodings()) {
      std::cerr << count << " messages in encoding \"" << encoding << "\", which is no CDR\n";
    }
    TellEnd(bag.torn_end());
  }

 private:
  std::map<std::string, std::pair<std::int64_t, std::string>> by_topic_;
};

// Nothing of use: says what there is.
absl::Status NothingIn(const BagReader& bag, const std::string& path) {
  std::string topics;
  for (const auto& [topic, type] : bag.topics())
    absl::StrAppend(&topics, " ", topic, " (", type, ")");
  return absl::InvalidArgumentError(
      absl::StrCat(path, ": no scan and no gas reading that could be placed; its topics are:",
                   topics.empty() ? " none" : topics));
}

// The map that the mission has come to, and where all of it is.
absl::Status WriteMission(const IngestArguments& arguments, const Recorder& recorder,
                          RecordedMission& mission) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const MapSnapshot map, mission.Map());
  PLUMESCOUT_RETURN_IF_ERROR(recorder.status());
  PLUMESCOUT_RETURN_IF_ERROR(WriteMapFiles(map, arguments.out));
  std::cout << arguments.record << "\n" << arguments.out << "/map.yaml\n";
  return absl::OkStatus();
}

absl::Status IngestRobotRun(const IngestArguments& arguments, RobotRun run) {
  ProgressLine progress(absl::Seconds(2));
  PLUMESCOUT_ASSIGN_OR_RETURN(Recorder recorder,
                              Recorder::Create(arguments.record, MissionOptions()));
  RecordedMission mission(recorder);
  PLUMESCOUT_RETURN_IF_ERROR(mission.Begin(run.robot(), run.radius_m(), run.outfit()));
  const absl::Time start = absl::Now();
  std::int64_t count = 0;
  while (true) {
    PLUMESCOUT_ASSIGN_OR_RETURN(std::optional<Observation> observation, run.Next());
    if (!observation) break;
    if (std::holds_alternative<SequenceGap>(observation->payload)) continue;  // numbers are new
    ++count;
    PLUMESCOUT_RETURN_IF_ERROR(mission.Add(observation->sample_time_ns, observation->pose,
                                           std::move(observation->payload)));
    progress.Show(
        absl::StrCat(ProgressWithTimeLeft(run.share_read(), absl::Now() - start), "  ingest"));
  }
  if (run.senseless() > 0) {
    std::cerr << "passed over " << run.senseless()
              << ", first for: " << run.first_senseless().message() << "\n";
  }
  mission.TellRefusals();
  TellEnd(run.torn_end());
  if (count == 0) {
    return absl::InvalidArgumentError(
        absl::StrCat(arguments.bag, ": robot ", run.robot(), " has sensed nothing"));
  }
  progress.Finish(absl::StrCat("Ingested: ", count, " observations of robot ", run.robot()));
  return WriteMission(arguments, recorder, mission);
}

absl::Status IngestBag(IngestArguments arguments) {
  if (!arguments.gas_calibration.empty()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(arguments.intake.gas_calibration,
                                client::ReadCalibration(arguments.gas_calibration));
  }
  ProgressLine progress(absl::Seconds(2));
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::unique_ptr<BagReader> bag,
                              OpenBag(arguments.bag, arguments.topics.all()));
  PLUMESCOUT_ASSIGN_OR_RETURN(Recorder recorder,
                              Recorder::Create(arguments.record, MissionOptions()));
  RecordedMission mission(recorder);
  PLUMESCOUT_RETURN_IF_ERROR(mission.Begin(arguments.robot, arguments.radius_m));
  Troubles troubles;
  BagIntake intake(
      arguments.topics, arguments.intake,
      [&](const std::string& about, const absl::Status& why) { troubles.Add(about, why); },
      [&](std::int64_t time_ns, const Pose2& pose, ObservationPayload payload) {
        return mission.Add(time_ns, pose, std::move(payload));
      });
  const absl::Time start = absl::Now();
  while (true) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::optional<BagMessage> message, bag->Next());
    if (!message) break;
    PLUMESCOUT_RETURN_IF_ERROR(intake.Take(*message));
    progress.Show(
        absl::StrCat(ProgressWithTimeLeft(bag->share_read(), absl::Now() - start), "  ingest"));
  }
  PLUMESCOUT_RETURN_IF_ERROR(intake.Finish());
  mission.TellRefusals();
  troubles.Tell(*bag);
  if (intake.counters().scans + intake.counters().gas_readings == 0) {
    return NothingIn(*bag, arguments.bag);
  }
  progress.Finish(absl::StrCat("Ingested: ", Describe(intake.counters())));
  return WriteMission(arguments, recorder, mission);
}

absl::Status Ingest(const IngestArguments& arguments) {
  PLUMESCOUT_ASSIGN_OR_RETURN(std::optional<RobotRun> run, RobotRun::Open(arguments.bag));
  return run ? IngestRobotRun(arguments, *std::move(run)) : IngestBag(arguments);
}

void AddTopics(CLI::App& command, IngestArguments& arguments) {
  BagTopics& topics = arguments.topics;
  command.add_option("--scan-topic", topics.scan)->capture_default_str();
  command.add_option("--odom-topic", topics.odometry)->capture_default_str();
  command.add_option("--tf-topic", topics.tf)->capture_default_str();
  command.add_option("--tf-static-topic", topics.tf_static)->capture_default_str();
  command.add_option("--gas-topic", topics.gas)->capture_default_str();
  client::IntakeOptions& intake = arguments.intake;
  command.add_option("--map-frame", intake.map_frame)->capture_default_str();
  command.add_option("--odom-frame", intake.odom_frame)->capture_default_str();
  command.add_option("--base-frame", intake.base_frame)->capture_default_str();
  command.add_option(
      "--gas-calibration", arguments.gas_calibration,
      "SCALE,EXPONENT: what is measured in VOLT or OHM is SCALE * raw ^ EXPONENT ppm");
}

}  // namespace

void AddIngestCommand(CLI::App& app, absl::Status& status) {
  CLI::App* command = app.add_subcommand(
      "ingest",
      "Make a mission of what a robot has sensed: of its own recording (--record of "
      "plumescout-robot or plumescout-ros2), or of a bag of rosbag2");
  const auto arguments = std::make_shared<IngestArguments>();
  command->add_option("bag", arguments->bag, "The file, .mcap or of a bag .db3")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("recording", arguments->record, "The recording that is made, for replay")
      ->required();
  command->add_option("--out", arguments->out, "Folder for map and gas fields")
      ->capture_default_str();
  command->add_option("--robot", arguments->robot, "Of a bag: its name in the mission")
      ->capture_default_str();
  command->add_option("--radius", arguments->radius_m, "Of a bag: of the robot's footprint, metres")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  AddTopics(*command, *arguments);
  command->callback([arguments, &status] { status = Ingest(*arguments); });
}

}  // namespace plumescout::lab
