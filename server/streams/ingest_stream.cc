// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/ingest_stream.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "server/base/errors.h"
#include "server/base/grpc_status.h"
#include "server/calls/patient_attempt.h"
#include "server/streams/ingest_frames.h"

namespace plumescout::server {

IngestStream* IngestStream::Start(const ServiceContext* context,
                                  grpc::CallbackServerContext* call) {
  auto stream = std::make_shared<IngestStream>(context);
  stream->self_ = stream;
  context->streams->Add(stream);
  const absl::Status entered =
      stream->visit_.Enter(*context->door, Rpc::kStreamObservations, *call);
  if (!entered.ok()) stream->End(entered);
  context->streams->LetIn(stream.get(), stream->visit_.info().recheck);
  stream->Pump();
  return stream.get();
}

void IngestStream::End(const absl::Status& status) {
  {
    absl::MutexLock lock(&mutex_);
    SetEnd(status, /*flush=*/false);
  }
  Pump();
}

void IngestStream::SetEnd(const absl::Status& status, bool flush) {
  flush_ = flush && (flush_ || !end_.has_value());
  if (!end_.has_value()) end_ = status;
}

void IngestStream::OnReadDone(bool ok) {
  const absl::Status status = ok ? HandleFrame() : absl::OkStatus();
  {
    absl::MutexLock lock(&mutex_);
    reading_ = false;
    if (!ok) half_closed_ = true;
    if (!status.ok()) SetEnd(status, /*flush=*/true);
  }
  Pump();
}

void IngestStream::OnWriteDone(bool ok) {
  {
    absl::MutexLock lock(&mutex_);
    writing_ = false;
    if (!ok) SetEnd(absl::CancelledError("the stream broke"), /*flush=*/false);
  }
  Pump();
}

void IngestStream::OnCancel() { End(GivenUp()); }

void IngestStream::OnDone() {
  context_.streams->Remove(this);
  if (host_ != nullptr) {
    host_->CloseStream(robot_.robot, stream_);
    host_->room().Withdraw(place_);
  }
  const auto self = std::move(self_);
  absl::MutexLock lock(&mutex_);
  waiting_.reset();
}

absl::Status IngestStream::HandleFrame() {
  switch (request_.frame_case()) {
    case v1::StreamObservationsRequest::kOpen:
      return BeginOpen();
    case v1::StreamObservationsRequest::kBatch:
      return TakeBatch(request_.batch());
    case v1::StreamObservationsRequest::FRAME_NOT_SET:
      break;
  }
  return FieldError("frame", "must be one of open, batch");
}

absl::Status IngestStream::BeginOpen() {
  if (host_ != nullptr) return FieldError("open", "must come once, as the first frame");
  {
    absl::MutexLock lock(&mutex_);
    opening_ = true;
  }
  const auto self = shared_from_this();
  AttemptPatiently(
      context_, visit_.info().deadline,
      [self] {
        // Who is gone must not take the place of a stream that came since.
        return self->HasEnded() ? absl::OkStatus() : self->Open(self->request_.open());
      },
      [self](const absl::Status& status) { self->OpenTried(status); });
  return absl::OkStatus();
}

bool IngestStream::HasEnded() {
  absl::MutexLock lock(&mutex_);
  return end_.has_value();
}

void IngestStream::OpenTried(const absl::Status& status) {
  {
    absl::MutexLock lock(&mutex_);
    opening_ = false;
    if (!status.ok()) SetEnd(status, /*flush=*/true);
  }
  Pump();
}

absl::Status IngestStream::Open(const v1::OpenIngest& open) {
  PLUMESCOUT_ASSIGN_OR_RETURN(robot_, ParseRobotName("open.robot", open.robot()));
  PLUMESCOUT_ASSIGN_OR_RETURN(host_, context_.FindMissionOf(visit_.caller(), robot_));
  PLUMESCOUT_RETURN_IF_ERROR(host_->CheckMayWrite());
  lease_token_ = open.lease_token();
  const std::weak_ptr<IngestStream> weak = weak_from_this();
  PLUMESCOUT_ASSIGN_OR_RETURN(
      stream_,
      host_->leases().OpenStream(robot_.robot, lease_token_, [weak](const absl::Status& status) {
        if (const auto stream = weak.lock()) stream->End(status);
      }));
  const auto self = shared_from_this();
  return host_->Post(
      [self, open](MissionWriter& writer) {
        const auto position = writer.conduct().Position(self->robot_.robot);
        if (!position.ok()) return self->End(position.status());
        const absl::Status fits = CheckNotRolledBack(open, *position, writer.metrics());
        if (!fits.ok()) return self->End(fits);
        self->Opened(*position);
      },
      [self](const absl::Status& status) { self->End(status); });
}

absl::Status IngestStream::TakeBatch(const v1::ObservationBatch& batch) {
  if (host_ == nullptr) return FieldError("open", "must be the first frame");
  const SteadyTime arrived = SteadyNow();
  const std::int64_t arrived_ns = host_->clock().now_ns();
  PLUMESCOUT_ASSIGN_OR_RETURN(auto incoming,
                              ReadBatch(batch, context_.limits.max_batch_observations));
  const IngestLoad load = LoadOf(incoming);
  const RateLoad rate_load = RateLoadOf(incoming, batch.ByteSizeLong());
  {
    absl::MutexLock lock(&mutex_);
    PLUMESCOUT_RETURN_IF_ERROR(CheckCredit(incoming, credit_sequence_));
    in_flight_observations_ += load.observations;
    waiting_ = std::move(incoming);
    arrived_ = arrived;
    times_ = {batch.sent_time_ns(), arrived_ns, read_late_};
  }
  PauseReading(host_->rates().CountBatch(robot_.robot, rate_load));
  place_ = host_->room().TakeOrWait(load, [weak = weak_from_this()](IngestRoom::Hold room) {
    if (const auto self = weak.lock()) self->PostBatch(std::move(room));
  });
  return absl::OkStatus();
}

void IngestStream::PostBatch(IngestRoom::Hold room) {
  std::vector<IncomingObservation> incoming;
  SteadyTime arrived;
  BatchTimes times;
  {
    absl::MutexLock lock(&mutex_);
    if (!waiting_.has_value()) return;  // the stream is over
    // It stays in place until it is posted: the next batch must not be read, and overtake it.
    incoming = std::move(*waiting_);
    arrived = arrived_;
    times = times_;
  }
  const int count = static_cast<int>(incoming.size());
  const auto self = shared_from_this();
  const absl::Status posted =
      host_->Post({[self, count, arrived, times,
                    incoming = std::move(incoming)](MissionWriter& writer) mutable {
                     IngestResult result =
                         self->host_->Ingest(writer, self->robot_.robot, self->lease_token_,
                                             std::move(incoming), times);
                     writer.NoteIngest(arrived);
                     self->Ingested(count, std::move(result));
                   },
                   [self, count](const absl::Status& status) { self->Dropped(count, status); },
                   std::move(room)});
  {
    absl::MutexLock lock(&mutex_);
    waiting_.reset();
  }
  if (!posted.ok()) return Dropped(count, posted);
  Pump();
}

void IngestStream::Dropped(int observations, const absl::Status& status) {
  {
    absl::MutexLock lock(&mutex_);
    in_flight_observations_ -= observations;
    SetEnd(status, /*flush=*/true);
  }
  Pump();
}

void IngestStream::PauseReading(absl::Duration pause) {
  if (pause <= absl::ZeroDuration()) return;
  {
    absl::MutexLock lock(&mutex_);
    paused_ = true;
  }
  // The next frame is read after the alarm only. A new one, for the last may still be ringing.
  alarm_ = std::make_unique<grpc::Alarm>();
  alarm_->Set(std::chrono::system_clock::now() + absl::ToChronoMicroseconds(pause),
              [weak = weak_from_this()](bool) {
                if (const auto stream = weak.lock()) stream->GoOnReading();
              });
}

void IngestStream::GoOnReading() {
  {
    absl::MutexLock lock(&mutex_);
    paused_ = false;
  }
  Pump();
}

void IngestStream::Opened(const LogPosition& position) {
  bool await = false;
  {
    absl::MutexLock lock(&mutex_);
    opened_ = true;
    greeting_due_ = true;
    position_ = position;
    await = BeginAwaitDurable();
  }
  if (await) AwaitDurable();
  Pump();
}

void IngestStream::Ingested(int observations, IngestResult result) {
  bool await = false;
  {
    absl::MutexLock lock(&mutex_);
    in_flight_observations_ -= observations;
    position_ = result.position;
    ack_due_ = true;
    std::move(result.refused.begin(), result.refused.end(), std::back_inserter(refused_));
    if (!result.status.ok()) SetEnd(result.status, /*flush=*/true);
    await = BeginAwaitDurable();
  }
  if (await) AwaitDurable();
  Pump();
}

bool IngestStream::BeginAwaitDurable() {
  const MissionJournal& journal = host_->journal();
  const std::int64_t applied = position_.applied_sequence;
  if (!journal.is_durable() || awaits_durable_ || end_.has_value() ||
      journal.DurableSequence(robot_.robot, applied) == applied) {
    return false;
  }
  awaits_durable_ = true;
  return true;
}

void IngestStream::AwaitDurable() {
  host_->WhenDurable([weak = weak_from_this()](const absl::Status& status) {
    if (const auto self = weak.lock()) self->BecameDurable(status);
  });
}

void IngestStream::BecameDurable(const absl::Status& status) {
  bool await = false;
  {
    absl::MutexLock lock(&mutex_);
    awaits_durable_ = false;
    ack_due_ = true;
    if (!status.ok()) SetEnd(status, /*flush=*/true);
    await = BeginAwaitDurable();
  }
  if (await) AwaitDurable();
  Pump();
}

void IngestStream::Pump() {
  const auto self = shared_from_this();  // the finish may end us
  pump_.Run(mutex_, [this] {
    mutex_.AssertHeld();
    return NextOperation();
  });
}

StreamPump::Operation IngestStream::NextOperation() {
  if (finished_ || opening_) return nullptr;
  const bool broken_off = end_.has_value() && !flush_;
  // Who says that it has sent everything hears that it is durable.
  const bool over = end_.has_value() || (half_closed_ && !awaits_durable_);
  if (!writing_ && !broken_off && FillResponse()) {
    writing_ = true;
    return [this, response = &response_] { StartWrite(response); };
  }
  if (!writing_ && (broken_off || (over && in_flight_observations_ == 0))) {
    finished_ = true;
    return [this, status = end_.value_or(absl::OkStatus())] {
      Finish(ToGrpc(visit_.Leave(status), visit_.info().request_id));
    };
  }
  if (!reading_ && HoldsBack()) held_back_ = true;
  if (MayRead()) {
    reading_ = true;
    read_late_ = std::exchange(held_back_, false);
    return [this] { StartRead(&request_); };
  }
  return nullptr;
}

bool IngestStream::FillResponse() {
  response_.Clear();
  if (!greeting_due_ && !refused_.empty()) {
    *response_.mutable_rejected() = ToRejected(refused_.front());
    refused_.pop_front();
    return true;
  }
  if (!greeting_due_ && !ack_due_) return false;
  const v1::IngestState state = ToIngestState(position_, robot_.robot, host_->journal(),
                                              context_.limits.stream_window_observations);
  if (std::exchange(greeting_due_, false)) {
    *response_.mutable_opened()->mutable_ingest_state() = state;
    response_.mutable_opened()->set_server_boot_id(context_.boot_id);
  } else {
    ack_due_ = false;
    *response_.mutable_ack() = state;
  }
  credit_sequence_ = std::max(credit_sequence_, state.credit_sequence());
  return true;
}

bool IngestStream::MayRead() const {
  return !reading_ && !half_closed_ && !end_.has_value() && !HoldsBack();
}

bool IngestStream::HoldsBack() const {
  const bool opening = host_ != nullptr && !opened_;
  return opening || paused_ || waiting_.has_value() ||
         in_flight_observations_ >= context_.limits.stream_window_observations;
}

}  // namespace plumescout::server
