// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/calls/unary_call.h"

#include <utility>

#include "server/base/grpc_status.h"
#include "server/calls/patient_attempt.h"
#include "server/calls/service_context.h"

namespace plumescout::server {
namespace {

absl::Status GivenUp() { return absl::CancelledError("the caller gave up"); }

void EndStage(const UnaryCall& call, Stage stage, SteadyTime began) {
  call.info().stage_times->Add(stage, absl::FromChrono(SteadyNow() - began));
}

}  // namespace

UnaryCall* UnaryCall::Start(const ServiceContext& context, Rpc rpc,
                            grpc::CallbackServerContext* call, Handler handle) {
  auto unary = std::make_shared<UnaryCall>();
  unary->self_ = unary;
  // For those who may answer: when the last of them lets go, nobody will.
  const std::shared_ptr<UnaryCall> handle_of_call(unary.get(), [unary](UnaryCall* reactor) {
    reactor->Answer(reactor->is_cancelled()
                        ? GivenUp()
                        : absl::UnavailableError("the server let go of the call; try again"));
  });
  const absl::Status entered = unary->visit_.Enter(*context.door, rpc, *call);
  if (!entered.ok()) {
    unary->Answer(entered);
    return unary.get();
  }
  AttemptPatiently(
      context, unary->info().deadline,
      [handle = std::move(handle), handle_of_call] { return handle(handle_of_call); },
      [unary](const absl::Status& status) {
        if (!status.ok()) unary->Answer(status);
      });
  return unary.get();
}

bool UnaryCall::is_cancelled() const {
  absl::MutexLock lock(&mutex_);
  return cancelled_;
}

void UnaryCall::WhenCancelled(std::function<void()> stop) {
  {
    absl::MutexLock lock(&mutex_);
    if (!cancelled_) {
      stop_ = std::move(stop);
      return;
    }
  }
  stop();
}

void UnaryCall::BeforeAnswer(std::function<void(const absl::Status&)> look) {
  absl::MutexLock lock(&mutex_);
  look_ = std::move(look);
}

void UnaryCall::Answer(const absl::Status& status) {
  std::function<void(const absl::Status&)> look;
  {
    absl::MutexLock lock(&mutex_);
    if (std::exchange(answered_, true)) return;
    look.swap(look_);
  }
  if (look) look(status);
  Finish(ToGrpc(visit_.Leave(status), info().request_id));
}

void UnaryCall::OnCancel() {
  std::function<void()> stop;
  {
    absl::MutexLock lock(&mutex_);
    cancelled_ = true;
    stop = std::exchange(stop_, nullptr);
  }
  if (stop) stop();
}

void UnaryCall::OnDone() {
  const auto self = std::move(self_);
  std::function<void()> stop;  // it may hold this call in turn
  absl::MutexLock lock(&mutex_);
  stop.swap(stop_);
}

absl::Status PostFor(const std::shared_ptr<UnaryCall>& call, MissionHost& host,
                     MissionHost::Task command) {
  return host.Post(
      [call, posted = SteadyNow(), command = std::move(command)](MissionWriter& writer) {
        EndStage(*call, Stage::kCommit, posted);
        command(writer);
      },
      Refusal(call));
}

void AnswerWhenDurable(MissionHost& host, const std::shared_ptr<UnaryCall>& call,
                       const absl::Status& status) {
  if (!status.ok()) return call->Answer(status);
  host.WhenDurable([call, began = SteadyNow()](const absl::Status& durable) {
    EndStage(*call, Stage::kDurable, began);
    call->Answer(durable);
  });
}

absl::Status AnswerInTurn(const std::shared_ptr<UnaryCall>& call, absl::string_view mission,
                          FairPool* pool, std::function<absl::Status()> task) {
  return pool->Submit(TurnOf(call->info(), mission),
                      {[call, task = std::move(task), queued = SteadyNow()] {
                         EndStage(*call, Stage::kQueue, queued);
                         if (call->is_cancelled()) return call->Answer(GivenUp());
                         const SteadyTime began = SteadyNow();
                         const absl::Status status = task();
                         EndStage(*call, Stage::kRead, began);
                         call->Answer(status);
                       },
                       [call] { return call->is_cancelled(); }});
}

absl::Status AnswerFromBelief(const std::shared_ptr<MissionHost>& host, FairPool* pool,
                              const std::shared_ptr<UnaryCall>& call, BeliefWish wish,
                              std::function<absl::Status(const Belief&)> read) {
  call->WhenCancelled([host] { host->Wake(); });
  return host->AwaitBelief(
      {.wish = std::move(wish),
       .deadline = call->info().deadline,
       .abandoned = [call] { return call->is_cancelled(); }},
      [call, pool, mission = host->id(), asked = SteadyNow(),
       read = std::move(read)](absl::StatusOr<std::shared_ptr<const Belief>> belief) {
        EndStage(*call, Stage::kBelief, asked);
        if (!belief.ok()) return call->Answer(belief.status());
        const absl::Status queued = AnswerInTurn(
            call, mission, pool, [read, belief = *std::move(belief)] { return read(*belief); });
        if (!queued.ok()) call->Answer(queued);
      });
}

}  // namespace plumescout::server
