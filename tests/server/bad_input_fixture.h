// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "tests/server/bad_input.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {

class BadInputTest : public ServiceTest {
 protected:
  using Sender = std::function<absl::Status(const Message&)>;

  // Mission "hall" has a robot with a scan, a reading and a plan, which leaves its posterior fresh.
  void SetUp() override {
    ServerConfig config;
    config.limits.max_costly_calls_per_s = 0.0;  // the map is read before and after each row
    config.limits.memory_budget_bytes = 3 * config.mission.memory_budget_bytes - 1;
    StartServerWithStore(config);
    lease_ = Lease();
    ASSERT_TRUE(Ingest(kRobot, lease_, RoomScan(1)).ok());
    ASSERT_TRUE(Ingest(kRobot, lease_, GasReadings(2, 2)).ok());
    ASSERT_TRUE(NextBest(PlanFor(lease_)).ok());
  }

  template <typename Stub, typename Request, typename Response>
  Sender SenderOf(std::unique_ptr<Stub>& stub,
                  grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*)) {
    return [this, &stub, method](const Message& request) {
      return Call(stub, method, static_cast<const Request&>(request)).status();
    };
  }
  // The refusal of the batch or of its observation.
  absl::Status SendBatch(const Message& message) {
    const auto& request = static_cast<const v1::BatchIngestObservationsRequest&>(message);
    const auto response = Call(ingest_, &v1::IngestService::Stub::BatchIngestObservations, request);
    if (!response.ok()) return response.status();
    return response->rejections().empty() ? absl::OkStatus()
                                          : FromProto(response->rejections(0).status());
  }
  absl::Status SendOnStream(const Message& message) {
    const auto& request = static_cast<const v1::BatchIngestObservationsRequest&>(message);
    IngestClient stream(*ingest_);
    stream.Open(request.open().robot(), request.open().lease_token());
    stream.Send(request.batch());
    for (auto frame = stream.Read(); frame.frame_case() != 0; frame = stream.Read()) {
      if (frame.has_rejected()) return FromProto(frame.rejected().status());
    }
    return stream.Finish();
  }

  // Opens an import before other parts.
  absl::Status SendImport(const Message& message) {
    const auto& request = static_cast<const v1::ImportMissionRequest&>(message);
    ImportClient import(*snapshots_);
    if (!request.has_start()) import.Open("attic");
    import.Send(request);
    return import.Finish().status();
  }

  v1::BatchIngestObservationsRequest GoodBatch() {
    v1::BatchIngestObservationsRequest request;
    request.mutable_open()->set_robot(kRobot);
    request.mutable_open()->set_lease_token(lease_);
    *request.mutable_batch() = RoomScan(AppliedSequence() + 1);
    return request;
  }
  v1::ReportProgressRequest GoodReport() const {
    v1::ReportProgressRequest request;
    request.set_robot(kRobot);
    request.set_lease_token(lease_);
    request.set_plan("missions/hall/plans/1");
    request.set_outcome(v1::ReportProgressRequest::OUTCOME_REACHED);
    return request;
  }

  std::int64_t AppliedSequence() { return GetMap()->status().robots(0).applied_sequence(); }
  // All that a bad request must not change: the map, and which missions there are.
  std::string State() {
    auto map = GetMap(/*full_precision=*/true);
    EXPECT_TRUE(map.ok()) << map.status();
    if (!map.ok()) return "";
    map->clear_revision();
    for (auto& robot : *map->mutable_status()->mutable_robots()) {
      robot.clear_applied_sequence();
      robot.clear_rejected_observation_count();
    }
    const auto list =
        Call(missions_, &v1::MissionService::Stub::ListMissions, v1::ListMissionsRequest());
    return absl::StrCat(map->SerializeAsString(), list->missions_size());
  }

  // `revisions`: by which a refusal moves the mission.
  void Check(const BadInputs& inputs, const std::function<std::unique_ptr<Message>()>& good,
             const Sender& send, int revisions = 0) {
    for (const BadInput& row : inputs.rows()) {
      SCOPED_TRACE(absl::StrCat(row.field, ": ", row.what.substr(0, 80)));
      const std::int64_t revision = Revision();
      const std::string state = State();
      const auto request = good();
      row.spoil(*request);
      const absl::Status refused = send(*request);
      if (row.code == absl::StatusCode::kInvalidArgument) {
        EXPECT_THAT(refused, RefusesField(row.blamed));
      } else {
        EXPECT_THAT(refused, Refuses(row.code, row.blamed));
      }
      EXPECT_EQ(Revision(), revision + revisions);
      EXPECT_TRUE(State() == state);  // not EXPECT_EQ: it would print the map
    }
  }
  template <typename Request>
  static std::function<std::unique_ptr<Message>()> Copies(const Request& request) {
    return [request] { return std::make_unique<Request>(request); };
  }
  std::function<std::unique_ptr<Message>()> GoodBatches() {
    return [this] { return std::make_unique<v1::BatchIngestObservationsRequest>(GoodBatch()); };
  }

  std::int64_t lease_ = 0;
};

}  // namespace plumescout::server
