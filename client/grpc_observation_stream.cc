// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/grpc_observation_stream.h"

#include <grpcpp/grpcpp.h>

#include <deque>
#include <functional>
#include <string>
#include <utility>

#include "absl/time/clock.h"
#include "client/grpc_status.h"
#include "client/ingest_messages.h"
#include "core/types/status_macros.h"
#include "proto/convert/observation.h"
#include "proto/convert/status.h"

namespace plumescout::client {
namespace {

// Of a request; the rest is for what goes around them.
constexpr double kRoomForObservations = 0.75;
// How long a failed call is given to say why before it is cancelled.
constexpr absl::Duration kEndGrace = absl::Milliseconds(200);

// An operation on the call; its value is the completion queue's tag.
enum class Op : std::intptr_t { kStart = 1, kRead, kWrite, kWritesDone, kFinish };

void* TagOf(Op op) { return reinterpret_cast<void*>(static_cast<std::intptr_t>(op)); }

// One bidirectional call driven through a completion queue of its own, so that every wait has a
// deadline and no thread is needed. A read is always under way while the call lives.
class GrpcObservationStream final : public ObservationStream {
 public:
  GrpcObservationStream(MissionRoutes& routes, const StreamTimeouts& timeouts,
                        std::size_t max_frame_bytes)
      : routes_(routes), timeouts_(timeouts), max_frame_bytes_(max_frame_bytes) {}
  ~GrpcObservationStream() override;

  absl::Status Open(v1::IngestService::Stub& stub, const RobotSession& session,
                    absl::Time deadline);
  // Whether it has ended because another server has the mission, which is known now.
  bool is_elsewhere() const { return is_elsewhere_; }

  const IngestState& opened() const override { return opened_; }
  std::string server_boot_id() const override { return server_boot_id_; }
  absl::Status Write(const std::vector<Observation>& batch) override;
  absl::StatusOr<IngestReply> Read(absl::Duration timeout) override;
  absl::Status Finish() override;

 private:
  // Runs completions until `op` has completed; returns its success. False after the deadline.
  bool Await(Op op, absl::Time deadline);
  // Runs one completion; false after the deadline.
  bool RunOne(absl::Time deadline);
  void OnRead(bool ok);
  absl::Status WriteFrame(const v1::StreamObservationsRequest& frame);
  absl::Status TakeOpened();
  // Ends the call, if it has not ended, and says why it did. Never OK.
  // Of a call that hangs: it ends now, and the next may go to another server.
  void HangUp();
  absl::Status EndedStatus();
  absl::Status AwaitFinish(absl::Time deadline);
  absl::Status Broken(absl::Status status);
  void StartRead();

  absl::Status WriteBatch(v1::StreamObservationsRequest& frame);

  MissionRoutes& routes_;
  const StreamTimeouts timeouts_;
  const std::size_t max_frame_bytes_;  // of observations
  std::string mission_;
  std::string node_;  // that it is addressed to
  bool is_elsewhere_ = false;
  std::function<std::int64_t()> robot_clock_ns_;  // see RobotSession
  grpc::ClientContext context_;
  grpc::CompletionQueue queue_;
  std::unique_ptr<
      grpc::ClientAsyncReaderWriter<v1::StreamObservationsRequest, v1::StreamObservationsResponse>>
      call_;
  IngestState opened_;
  std::string server_boot_id_;

  v1::StreamObservationsResponse incoming_;
  std::deque<v1::StreamObservationsResponse> replies_;
  bool reads_ended_ = true;  // the server has said all it will; no read is under way
  bool closing_ = false;     // nothing may be started any more
  Op completed_ = Op::kStart;
  bool completed_ok_ = false;
  bool finish_started_ = false;
  bool finished_ = false;
  grpc::Status final_;
};

GrpcObservationStream::~GrpcObservationStream() {
  context_.TryCancel();
  if (call_ != nullptr) AwaitFinish(absl::InfiniteFuture()).IgnoreError();
  closing_ = true;
  queue_.Shutdown();
  while (RunOne(absl::InfiniteFuture())) {
  }
}

absl::Status GrpcObservationStream::Open(v1::IngestService::Stub& stub, const RobotSession& session,
                                         absl::Time deadline) {
  robot_clock_ns_ = session.robot_clock_ns;
  mission_ = session.mission;
  node_ = routes_.Address(mission_, context_);
  call_ = stub.PrepareAsyncStreamObservations(&context_, &queue_);
  call_->StartCall(TagOf(Op::kStart));
  if (!RunOne(deadline)) {  // it might wait for its turn on the connection for ever
    HangUp();
    RunOne(absl::InfiniteFuture());
  }
  if (!completed_ok_) return EndedStatus();
  StartRead();
  v1::StreamObservationsRequest frame;
  *frame.mutable_open() = OpeningOf(session);
  PLUMESCOUT_RETURN_IF_ERROR(WriteFrame(frame));
  while (replies_.empty() && !reads_ended_ && RunOne(deadline)) {
  }
  return TakeOpened();
}

absl::Status GrpcObservationStream::TakeOpened() {
  if (replies_.empty()) return EndedStatus();
  const v1::StreamObservationsResponse first = std::move(replies_.front());
  replies_.pop_front();
  if (!first.has_opened()) {
    return Broken(absl::InternalError("the server's first frame is not IngestOpened"));
  }
  server_boot_id_ = first.opened().server_boot_id();
  opened_ = StateFromProto(first.opened().ingest_state());
  return absl::OkStatus();
}

absl::Status GrpcObservationStream::Write(const std::vector<Observation>& batch) {
  if (finish_started_) return EndedStatus();
  v1::StreamObservationsRequest frame;
  std::size_t frame_bytes = 0;
  for (const Observation& observation : batch) {
    v1::Observation proto = ToProto(observation);
    const std::size_t bytes = proto.ByteSizeLong();
    if (frame_bytes > 0 && frame_bytes + bytes > max_frame_bytes_) {
      PLUMESCOUT_RETURN_IF_ERROR(WriteBatch(frame));
      frame.Clear();
      frame_bytes = 0;
    }
    *frame.mutable_batch()->add_observations() = std::move(proto);
    frame_bytes += bytes;
  }
  return frame_bytes > 0 ? WriteBatch(frame) : absl::OkStatus();
}

absl::Status GrpcObservationStream::WriteBatch(v1::StreamObservationsRequest& frame) {
  if (robot_clock_ns_) frame.mutable_batch()->set_sent_time_ns(robot_clock_ns_());
  return WriteFrame(frame);
}

absl::StatusOr<IngestReply> GrpcObservationStream::Read(absl::Duration timeout) {
  const absl::Time deadline = absl::Now() + timeout;
  while (replies_.empty()) {
    if (reads_ended_) return EndedStatus();
    if (!RunOne(deadline)) return absl::DeadlineExceededError("no reply yet");
  }
  const v1::StreamObservationsResponse reply = std::move(replies_.front());
  replies_.pop_front();
  switch (reply.frame_case()) {
    case v1::StreamObservationsResponse::kAck:
      return StateFromProto(reply.ack());
    case v1::StreamObservationsResponse::kRejected:
      return ObservationRejected{.sequence = reply.rejected().sequence(),
                                 .status = FromProto(reply.rejected().status())};
    default:
      return Broken(absl::InternalError("the server sent a frame that has no place here"));
  }
}

absl::Status GrpcObservationStream::Finish() {
  if (finished_) return FromGrpc(final_);
  const absl::Time deadline = absl::Now() + timeouts_.write;
  call_->WritesDone(TagOf(Op::kWritesDone));
  Await(Op::kWritesDone, deadline);
  while (!reads_ended_ && RunOne(deadline)) {
  }
  return AwaitFinish(deadline);
}

bool GrpcObservationStream::Await(Op op, absl::Time deadline) {
  while (RunOne(deadline)) {
    if (completed_ == op) return completed_ok_;
  }
  return false;
}

bool GrpcObservationStream::RunOne(absl::Time deadline) {
  void* tag = nullptr;
  bool ok = false;
  if (queue_.AsyncNext(&tag, &ok, absl::ToChronoTime(deadline)) !=
      grpc::CompletionQueue::GOT_EVENT) {
    return false;
  }
  completed_ = static_cast<Op>(reinterpret_cast<std::intptr_t>(tag));
  completed_ok_ = ok;
  if (completed_ == Op::kRead) OnRead(ok);
  if (completed_ == Op::kFinish) {
    finished_ = true;
    is_elsewhere_ = routes_.Note(mission_, node_, final_, context_);
  }
  return true;
}

void GrpcObservationStream::OnRead(bool ok) {
  if (!ok) {
    reads_ended_ = true;
    return;
  }
  replies_.push_back(std::move(incoming_));
  if (!closing_) StartRead();
}

void GrpcObservationStream::StartRead() {
  incoming_.Clear();
  reads_ended_ = false;
  call_->Read(&incoming_, TagOf(Op::kRead));
}

absl::Status GrpcObservationStream::WriteFrame(const v1::StreamObservationsRequest& frame) {
  call_->Write(frame, TagOf(Op::kWrite));
  return Await(Op::kWrite, absl::Now() + timeouts_.write) ? absl::OkStatus() : EndedStatus();
}

void GrpcObservationStream::HangUp() {
  routes_.Forget(mission_, node_);
  context_.TryCancel();
}

absl::Status GrpcObservationStream::EndedStatus() {
  // If the server ended the call, the read under way ends too and the status is the server's.
  const absl::Time deadline = absl::Now() + kEndGrace;
  while (!reads_ended_ && RunOne(deadline)) {
  }
  if (!reads_ended_) HangUp();
  const absl::Status status = AwaitFinish(absl::InfiniteFuture());
  switch (status.code()) {
    case absl::StatusCode::kOk:
      return absl::UnavailableError("the server closed the stream");
    case absl::StatusCode::kCancelled:
      return absl::UnavailableError("the server did not answer in time");
    case absl::StatusCode::kDeadlineExceeded:  // which means something else to readers
      return absl::UnavailableError(status.message());
    default:
      return status;
  }
}

absl::Status GrpcObservationStream::AwaitFinish(absl::Time deadline) {
  if (!finish_started_) {
    finish_started_ = true;
    call_->Finish(&final_, TagOf(Op::kFinish));
  }
  while (!finished_ && RunOne(deadline)) {
  }
  return finished_ ? FromGrpc(final_) : absl::DeadlineExceededError("the server does not finish");
}

absl::Status GrpcObservationStream::Broken(absl::Status status) {
  context_.TryCancel();
  return status;
}

}  // namespace

absl::StatusOr<std::unique_ptr<ObservationStream>> OpenGrpcObservationStream(
    MissionRoutes& routes, v1::IngestService::Stub& stub, const RobotSession& session,
    const StreamTimeouts& timeouts, std::int64_t max_request_bytes) {
  const absl::Time deadline = absl::Now() + timeouts.open;
  const auto max_frame_bytes =
      static_cast<std::size_t>(static_cast<double>(max_request_bytes) * kRoomForObservations);
  for (int redirect = 0;; ++redirect) {
    auto stream = std::make_unique<GrpcObservationStream>(routes, timeouts, max_frame_bytes);
    const absl::Status status = stream->Open(stub, session, deadline);
    if (status.ok()) return stream;
    if (!stream->is_elsewhere() || redirect == MissionRoutes::kMaxRedirects) return status;
  }
}

}  // namespace plumescout::client
