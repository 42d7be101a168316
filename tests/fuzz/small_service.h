// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <google/protobuf/message.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/mission/conduct/lease_book.h"
#include "core/mission/conduct/mission_conduct.h"
#include "core/plan/strategy.h"
#include "core/types/options.h"
#include "plumescout/v1/ingest_service.pb.h"
#include "plumescout/v1/map_service.pb.h"
#include "plumescout/v1/mission_service.pb.h"
#include "plumescout/v1/planning_service.pb.h"
#include "plumescout/v1/robot_service.pb.h"
#include "plumescout/v1/snapshot_service.pb.h"

namespace plumescout::fuzz {

// What the server's handlers make of requests, on one thread and without gRPC: conversion,
// validation and the conduct of one small mission. Requests that are refused have no effect.
class SmallService {
 public:
  SmallService();

  void Create(const v1::CreateMissionRequest& request);
  void Register(const v1::RegisterRobotRequest& request);
  void Remove(const v1::RemoveRobotRequest& request);
  void Ingest(const v1::BatchIngestObservationsRequest& request);
  void Stream(const v1::StreamObservationsRequest& request);
  void Next(const v1::NextBestTrajectoryRequest& request);
  void StreamNext(const v1::StreamNextBestTrajectoryRequest& request);
  void Check(const v1::CheckTrajectoryRequest& request);
  void ListFrontiers(const v1::ListFrontiersRequest& request);
  void Report(const v1::ReportProgressRequest& request);
  void GetMap(const v1::GetMapRequest& request);
  void WatchMap(const v1::WatchMapRequest& request);
  void QueryGas(const v1::QueryGasRequest& request);
  void ChangeKeepOut(const v1::ChangeKeepOutAreasRequest& request);
  void PlanTeam(const v1::PlanTeamRequest& request);
  void OrderHome(const v1::OrderHomeRequest& request);
  void ReleaseLease(const v1::ReleaseLeaseRequest& request);
  // Of these there is nothing to do but to read them.
  void Update(const v1::UpdateMissionRequest& request);
  void ListMissions(const v1::ListMissionsRequest& request);
  void ListRobots(const v1::ListRobotsRequest& request);
  void ListPlans(const v1::ListPlansRequest& request);
  void History(const v1::GetMissionHistoryRequest& request);
  void Figures(const v1::GetMissionFiguresRequest& request);
  void WatchRobot(const v1::WatchRobotRequest& request);
  void GetRobot(const v1::GetRobotRequest& request);
  // GetMission, DeleteMission, PauseMission, ResumeMission, FinishMission.
  template <typename Request>
  void Name(const Request& request);
  // Not a request: what clients make of an answer.
  void ReadMap(const v1::GetMapResponse& response);
  void ReadPlan(const v1::Plan& plan);

 private:
  void Begin(const MissionOptions& options);
  void Take(const std::string& robot, std::int64_t lease_token, const v1::ObservationBatch& batch);
  template <typename Request>
  void Plan(const Request& request);
  template <typename Request>
  void Read(const Request& request);

  std::unique_ptr<MissionConduct> conduct_;
  std::unique_ptr<const Strategy> strategy_;
  std::optional<LeaseBook> leases_;
  std::int64_t now_ns_ = 0;
  v1::OpenIngest open_;
};

struct HandledRequest {
  const google::protobuf::Message* prototype;
  std::function<void(SmallService&, const google::protobuf::Message&)> handle;
};

const std::vector<HandledRequest>& HandledRequests();

}  // namespace plumescout::fuzz
