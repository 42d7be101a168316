// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/run_robot.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/time/time.h"
#include "client/grpc_planner_client.h"
#include "client/grpc_viewer_client.h"
#include "client/robot_loop.h"
#include "client/robot_narrator.h"
#include "client/robot_recorder.h"
#include "client/ros2/complaints.h"
#include "client/ros2/dds_node.h"
#include "client/ros2/input_watch.h"
#include "client/ros2/map_relay.h"
#include "client/ros2/ros2_driver.h"
#include "core/types/status_macros.h"

namespace plumescout::client {
namespace {

// Nav2 takes a goal for reached within 0.25 m, unless it is told otherwise.
constexpr double kOthersTolerance_m = 0.4;
// At the end, for the robot to hear that it is to stand.
constexpr absl::Duration kLastWords = absl::Milliseconds(200);

// What a robot hears and says, and who tells of it.
class Ros2Robot {
 public:
  Ros2Robot(const RunFlags& flags, const RobotNarrator& narrator)
      : flags_(flags),
        narrator_(narrator),
        complaints_([&narrator](const std::string& text) { narrator.Say(text); }),
        intake_(flags.listen.intake, [this](const std::string& about, const absl::Status& why) {
          complaints_.Add(about, std::string(why.message()), Steady_ns());
        }) {}

  absl::Status Open() {
    PLUMESCOUT_ASSIGN_OR_RETURN(node_, DdsNode::Open(flags_.listen.domain));
    PLUMESCOUT_RETURN_IF_ERROR(ListenToRobot(flags_.listen.topics, *node_, intake_));
    PLUMESCOUT_ASSIGN_OR_RETURN(plan_publisher_,
                                PlanPublisher::Advertise(*node_, flags_.tell.plan));
    if (flags_.tell.map_period_s > 0.0) {
      PLUMESCOUT_ASSIGN_OR_RETURN(map_publisher_, MapPublisher::Advertise(*node_, flags_.tell.map));
    }
    inputs_.emplace(flags_.listen.topics, intake_, *node_);
    Ros2Ports ports{.listen = [this](absl::Duration timeout) { Listen(timeout); }};
    if (flags_.tell.plan.drives == Drives::kVelocity) {
      ports.drive = [this](const Twist& twist) { return Drive(twist); };
    }
    driver_.emplace(intake_, std::move(ports),
                    Ros2DriverOptions{.has_scanner = !flags_.listen.topics.scan.empty()});
    return absl::OkStatus();
  }

  Ros2Driver& driver() { return *driver_; }
  PlanPublisher& plan_publisher() { return *plan_publisher_; }
  bool publishes_maps() const { return map_publisher_ != nullptr; }

  // From any thread.
  void PublishMap(const MapSnapshot& map) {
    const absl::Status status = map_publisher_->Publish(map, clock_.Now_ns());
    if (!status.ok()) narrator_.Say(absl::StrCat("map: ", status.ToString()));
  }
  void SayCounters() const {
    narrator_.Say(Describe(intake_.counters()));
    if (intake_.jumps() > 0)
      narrator_.Say(absl::StrCat("SLAM moved its frame ", intake_.jumps(), " times"));
  }
  void LetLastWordsOut() { node_->AwaitHeard(kLastWords); }

 private:
  void Listen(absl::Duration timeout) {
    node_->Poll(timeout);
    if (driver_) clock_.Note(driver_->now_ns());
    if (Steady_ns() - looked_ns_ < Complaints::kSayAgain_ns) return;
    looked_ns_ = Steady_ns();
    for (const std::string& misfit : node_->TakeMisfits()) narrator_.Say(misfit);
    for (const std::string& what : inputs_->Missing()) {
      narrator_.Say(absl::StrCat("waiting: ", what));
    }
    if (driver_ && stands_still_)
      narrator_.Say("the robot is told to stand: its place is not known");
    stands_still_ = false;
    inputs_->Begin();
  }
  absl::Status Drive(const Twist& twist) {
    stands_still_ = stands_still_ || !driver_->knows_place();
    return plan_publisher_->PublishVelocity(twist, driver_->now_ns());
  }

  const RunFlags& flags_;
  const RobotNarrator& narrator_;
  Complaints complaints_;
  RobotIntake intake_;
  std::unique_ptr<DdsNode> node_;
  std::unique_ptr<PlanPublisher> plan_publisher_;
  std::unique_ptr<MapPublisher> map_publisher_;
  std::optional<InputWatch> inputs_;
  std::optional<Ros2Driver> driver_;
  RunningClock clock_;
  std::int64_t looked_ns_ = Steady_ns();
  bool stands_still_ = false;
};

// Has who listens to the robot hear of its plans.
class PlanTeller final : public RobotNarrator {
 public:
  PlanTeller(const RobotNarrator& narrator, Ros2Robot& robot)
      : RobotNarrator(narrator), robot_(robot) {}

  void OnPlan(const PlanArrival& arrival) override {
    RobotNarrator::OnPlan(arrival);
    const Pose2 pose = robot_.driver().pose();
    Check(robot_.plan_publisher().PublishPlan(arrival.plan, pose, arrival.time_ns));
  }
  void OnReport(PlanId plan, ProgressOutcome outcome) override {
    RobotNarrator::OnReport(plan, outcome);
    if (outcome == ProgressOutcome::kReached) return;
    const Ros2Driver& driver = robot_.driver();
    Check(robot_.plan_publisher().PublishStop(driver.pose(), driver.now_ns()));
  }

 private:
  void Check(const absl::Status& status) const {
    if (!status.ok()) Say(absl::StrCat("plan: ", status.ToString()));
  }

  Ros2Robot& robot_;
};

RobotLoopOptions OptionsOf(const RunFlags& flags) {
  RobotLoopOptions options = flags.robot.loop;
  options.real_clock = !flags.simulated_clock;
  options.answer_look_s = 0.01;  // scans come when they come
  if (flags.tell.plan.drives != Drives::kVelocity) {
    options.following = Following::kByOthers;
    options.follower.arrival_tolerance_m = kOthersTolerance_m;
  }
  if (flags.arrival_tolerance_m > 0.0) {
    options.follower.arrival_tolerance_m = flags.arrival_tolerance_m;
  }
  return options;
}

}  // namespace

absl::Status RunRobot(RunFlags flags, const StopFn& stop, const std::string& program) {
  std::optional<RobotRecorder> recorder;
  const RobotNarrator narrator(program, [&recorder](bool is_warning, const std::string& line) {
    if (recorder) recorder->OnSaid(is_warning, line);
  });
  PLUMESCOUT_RETURN_IF_ERROR(Prepare(flags.robot));
  PLUMESCOUT_RETURN_IF_ERROR(Prepare(flags.listen));
  const Participation& participation = flags.robot.loop.participation;
  Prepare(flags.listen, participation.frame, flags.tell);
  Ros2Robot robot(flags, narrator);
  PLUMESCOUT_RETURN_IF_ERROR(robot.Open());
  PLUMESCOUT_RETURN_IF_ERROR(robot.driver().AwaitPlace(absl::Seconds(flags.patience_s), stop));

  const auto link = MakeGrpcLink(flags.robot.client);
  const auto planner = MakeGrpcPlannerClient(link);
  const auto viewer = MakeGrpcViewerClient(link);
  PlanTeller teller(narrator, robot);
  RobotObserver* observer = &teller;
  if (!flags.robot.record_folder.empty()) {
    observer = &recorder.emplace(RecordingOf(flags.robot, program), participation,
                                 robot.driver().now_ns(), &teller);
  }
  std::optional<MapRelay> relay;
  if (robot.publishes_maps()) {
    relay.emplace(
        *viewer,
        MapRelayOptions{.mission = participation.mission,
                        .period = absl::Seconds(flags.tell.map_period_s)},
        MapRelay::Callbacks{.on_map = [&robot](const MapSnapshot& map) { robot.PublishMap(map); },
                            .on_broken =
                                [&narrator](const absl::Status& why) {
                                  if (absl::IsNotFound(why))
                                    return;  // the mission is about to be made
                                  narrator.Say(absl::StrCat("map: ", why.message()));
                                }});
  }
  RobotLoop loop(*planner, robot.driver(), OptionsOf(flags), *observer);
  const auto result = loop.Run(stop);
  robot.driver().Drive({}).IgnoreError();  // whatever has gone wrong
  robot.LetLastWordsOut();
  robot.SayCounters();
  if (!result.ok()) return result.status();
  narrator.SayResult(*result);
  return absl::OkStatus();
}

}  // namespace plumescout::client
