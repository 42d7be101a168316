// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/alarm.h>
#include <grpcpp/support/server_callback.h>

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"
#include "plumescout/v1/ingest_service.pb.h"
#include "proto/convert/names.h"
#include "server/calls/active_streams.h"
#include "server/calls/service_context.h"
#include "server/missions/mission_host.h"
#include "server/streams/stream_pump.h"

namespace plumescout::server {

// One robot's ingest stream: opens, hands batches to the mission's writer, and acknowledges what
// was applied, and again what has become durable. One write is in flight at a time, and the
// acknowledgement that follows is the newest one, however slowly the robot reads. Reading pauses
// while a window of observations is in flight, while a batch waits for room in the mission's queue,
// and while the robot is above its rates.
class IngestStream final
    : public grpc::ServerBidiReactor<v1::StreamObservationsRequest, v1::StreamObservationsResponse>,
      public EndableStream,
      public std::enable_shared_from_this<IngestStream> {
 public:
  // The reactor owns itself until gRPC is done with it.
  static IngestStream* Start(const ServiceContext* context, grpc::CallbackServerContext* call);

  explicit IngestStream(const ServiceContext* context) : context_(*context) {}

  // The first ending counts. What is due to the robot is not sent any more.
  void End(const absl::Status& status) override;

  void OnReadDone(bool ok) override;
  void OnWriteDone(bool ok) override;
  void OnCancel() override;
  void OnDone() override;

 private:
  absl::Status HandleFrame();
  // Sees to it that the mission is there, now or soon.
  absl::Status BeginOpen();
  absl::Status Open(const v1::OpenIngest& open);
  bool HasEnded() ABSL_LOCKS_EXCLUDED(mutex_);
  void OpenTried(const absl::Status& status) ABSL_LOCKS_EXCLUDED(mutex_);
  absl::Status TakeBatch(const v1::ObservationBatch& batch);
  // The batch that waits has room.
  void PostBatch(IngestRoom::Hold room) ABSL_LOCKS_EXCLUDED(mutex_);
  void Opened(const LogPosition& position);
  void Ingested(int observations, IngestResult result);
  void Dropped(int observations, const absl::Status& status);
  // Whether somebody has to AwaitDurable: not all that is applied is durable, and nobody does.
  bool BeginAwaitDurable() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // The robot will hear when what is applied now is durable.
  void AwaitDurable() ABSL_LOCKS_EXCLUDED(mutex_);
  void BecameDurable(const absl::Status& status);
  void PauseReading(absl::Duration pause);
  void GoOnReading();

  // Starts whatever can start now: a write, a read, the finish.
  void Pump() ABSL_LOCKS_EXCLUDED(mutex_);
  StreamPump::Operation NextOperation() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  bool FillResponse() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  bool MayRead() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // Whether the next frame is left on the wire for now, if there is one. No read is in flight.
  bool HoldsBack() const ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // `flush`: the robot first hears what became of its batches.
  void SetEnd(const absl::Status& status, bool flush) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const ServiceContext& context_;
  std::shared_ptr<IngestStream> self_;  // until OnDone
  Visit visit_;

  // Touched by the reading reactions only, which gRPC runs one after the other.
  v1::StreamObservationsRequest request_;
  std::shared_ptr<MissionHost> host_;
  RobotName robot_;
  std::int64_t lease_token_ = 0;
  StreamId stream_ = 0;                 // among the mission's
  IngestRoom::Place place_ = 0;         // of the batch taken last, among those who wait for room
  std::unique_ptr<grpc::Alarm> alarm_;  // of the last pause

  absl::Mutex mutex_;
  StreamPump pump_;
  v1::StreamObservationsResponse response_ ABSL_GUARDED_BY(mutex_);  // in flight if writing_
  bool opening_ ABSL_GUARDED_BY(mutex_) = false;                     // as if it was being read
  bool opened_ ABSL_GUARDED_BY(mutex_) = false;
  bool reading_ ABSL_GUARDED_BY(mutex_) = false;
  bool paused_ ABSL_GUARDED_BY(mutex_) = false;     // until the alarm
  bool held_back_ ABSL_GUARDED_BY(mutex_) = false;  // since the frame read last
  bool read_late_ ABSL_GUARDED_BY(mutex_) = false;  // before that frame
  bool writing_ ABSL_GUARDED_BY(mutex_) = false;
  bool half_closed_ ABSL_GUARDED_BY(mutex_) = false;
  bool finished_ ABSL_GUARDED_BY(mutex_) = false;
  bool greeting_due_ ABSL_GUARDED_BY(mutex_) = false;
  bool ack_due_ ABSL_GUARDED_BY(mutex_) = false;
  bool awaits_durable_ ABSL_GUARDED_BY(mutex_) = false;
  bool flush_ ABSL_GUARDED_BY(mutex_) = false;
  std::optional<absl::Status> end_ ABSL_GUARDED_BY(mutex_);
  // Waits for room.
  std::optional<std::vector<IncomingObservation>> waiting_ ABSL_GUARDED_BY(mutex_);
  SteadyTime arrived_ ABSL_GUARDED_BY(mutex_);                // when that came
  BatchTimes times_ ABSL_GUARDED_BY(mutex_);                  // of it, too
  int in_flight_observations_ ABSL_GUARDED_BY(mutex_) = 0;    // with those that wait for room
  std::int64_t credit_sequence_ ABSL_GUARDED_BY(mutex_) = 0;  // as announced
  LogPosition position_ ABSL_GUARDED_BY(mutex_);
  std::deque<RefusedObservation> refused_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace plumescout::server
