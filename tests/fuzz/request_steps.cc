// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/request_steps.h"

#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>

#include "proto/convert/observation.h"
#include "tests/fuzz/small_service.h"
#include "tests/support/box_room.h"

namespace plumescout::fuzz {
namespace {

constexpr std::size_t kStepHeader_bytes = 3;
constexpr std::size_t kMaxRequest_bytes = 0xFFFF;
constexpr char kMission[] = "missions/hall";
constexpr char kRobot[] = "missions/hall/robots/r1";
constexpr std::int64_t kToken = 1;  // of whoever registers first

using google::protobuf::Message;

v1::ObservationBatch* BatchOf(Message& message) {
  if (auto* request = dynamic_cast<v1::BatchIngestObservationsRequest*>(&message)) {
    return request->mutable_batch();
  }
  auto* frame = dynamic_cast<v1::StreamObservationsRequest*>(&message);
  return frame != nullptr && frame->has_batch() ? frame->mutable_batch() : nullptr;
}

void FillBatch(v1::ObservationBatch& batch) {
  const Pose2 pose{1.0, 1.5, 0.0};
  const Scan scan = support::ScanInBox(pose, 6.0, 4.0);
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  *batch.add_observations() = ToProto(Observation{1, kSecond_ns, pose, scan});
  *batch.add_observations() = ToProto(Observation{2, 2 * kSecond_ns, pose, scan});
  *batch.add_observations() = ToProto(Observation{3, 3 * kSecond_ns, pose, GasReading{5.0, 0.0}});
}

// By name of the field, for those that most requests have.
void FillNames(Message& message) {
  const auto* type = message.GetDescriptor();
  const auto set = [&](const char* name, const auto& value) {
    const auto* field = type->FindFieldByName(name);
    if (field == nullptr || field->message_type() != nullptr) return;
    if constexpr (std::is_convertible_v<decltype(value), std::string>) {
      message.GetReflection()->SetString(&message, field, value);
    } else {
      message.GetReflection()->SetInt64(&message, field, value);
    }
  };
  set("mission_id", std::string("hall"));
  set("robot_id", std::string("r1"));
  set("mission", std::string(kMission));
  set("robot", std::string(kRobot));
  set("lease_token", kToken);
  const bool is_of_robot = type->file()->name().ends_with("robot_service.proto");
  set("name", std::string(is_of_robot ? kRobot : kMission));
}

}  // namespace

void NumberObservations(Steps& steps) {
  std::int64_t sequence = 0;
  for (Step& step : steps) {
    v1::ObservationBatch* const batch = BatchOf(*step.request);
    if (batch == nullptr) continue;
    for (v1::Observation& observation : *batch->mutable_observations()) {
      observation.set_sequence(++sequence);
    }
  }
}

Steps ParseSteps(absl::string_view bytes) {
  Steps steps;
  while (bytes.size() > kStepHeader_bytes && steps.size() < kMaxSteps) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); };
    const std::size_t kind = byte(0) % HandledRequests().size();
    const std::size_t length = byte(1) + 256u * byte(2);
    const absl::string_view body = bytes.substr(kStepHeader_bytes, length);
    std::unique_ptr<Message> request(HandledRequests()[kind].prototype->New());
    if (!request->ParseFromArray(body.data(), static_cast<int>(body.size()))) break;
    steps.push_back({kind, std::move(request)});
    bytes.remove_prefix(kStepHeader_bytes + body.size());
  }
  return steps;
}

std::string SerializeSteps(const Steps& steps) {
  std::string bytes;
  for (const Step& step : steps) {
    const std::string body = step.request->SerializePartialAsString();
    if (body.size() > kMaxRequest_bytes) continue;
    bytes.push_back(static_cast<char>(step.kind));
    bytes.push_back(static_cast<char>(body.size() % 256));
    bytes.push_back(static_cast<char>(body.size() / 256));
    bytes += body;
  }
  return bytes;
}

Step GoodStep(std::size_t kind) {
  std::unique_ptr<Message> request(HandledRequests()[kind].prototype->New());
  FillNames(*request);
  if (auto* create = dynamic_cast<v1::CreateMissionRequest*>(request.get())) {
    create->mutable_options()->mutable_planning()->set_strategy("plumescout");
  } else if (auto* join = dynamic_cast<v1::RegisterRobotRequest*>(request.get())) {
    join->set_radius_m(0.2);
  } else if (auto* ingest = dynamic_cast<v1::BatchIngestObservationsRequest*>(request.get())) {
    FillNames(*ingest->mutable_open());
    FillBatch(*ingest->mutable_batch());
  } else if (auto* frame = dynamic_cast<v1::StreamObservationsRequest*>(request.get())) {
    FillNames(*frame->mutable_open());
  } else if (auto* check = dynamic_cast<v1::CheckTrajectoryRequest*>(request.get())) {
    check->mutable_path()->add_vertices()->set_x_m(1.0);
    check->mutable_path()->add_vertices()->set_y_m(2.0);
    check->mutable_path()->set_goal_kind(v1::GOAL_KIND_HOME);
  } else if (auto* report = dynamic_cast<v1::ReportProgressRequest*>(request.get())) {
    report->set_plan("missions/hall/plans/1");
    report->set_outcome(v1::ReportProgressRequest::OUTCOME_REACHED);
  } else if (auto* home = dynamic_cast<v1::OrderHomeRequest*>(request.get())) {
    home->set_home(true);
  } else if (auto* area = dynamic_cast<v1::ChangeKeepOutAreasRequest*>(request.get())) {
    v1::Polygon& polygon = *area->add_added();
    polygon.set_name("pit");
    for (const auto& [x_m, y_m] : {std::pair(4.0, 3.0), std::pair(5.0, 3.0), std::pair(5.0, 3.5)}) {
      v1::Point2D* const vertex = polygon.add_vertices();
      vertex->set_x_m(x_m);
      vertex->set_y_m(y_m);
    }
  } else if (auto* update = dynamic_cast<v1::UpdateMissionRequest*>(request.get())) {
    update->mutable_mission()->set_name(kMission);
    update->mutable_mission()->mutable_idle_time_to_live()->set_seconds(60);
    update->mutable_update_mask()->add_paths("idle_time_to_live");
  } else if (auto* query = dynamic_cast<v1::QueryGasRequest*>(request.get())) {
    query->add_points()->set_x_m(1.0);
  }
  return {kind, std::move(request)};
}

Steps GoodSteps() {
  Steps steps;
  for (std::size_t kind = 0; kind < HandledRequests().size(); ++kind) {
    // Who is removed plans no more.
    if (HandledRequests()[kind].prototype->GetDescriptor()->name() == "RemoveRobotRequest")
      continue;
    steps.push_back(GoodStep(kind));
  }
  NumberObservations(steps);
  return steps;
}

}  // namespace plumescout::fuzz
