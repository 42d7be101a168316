// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/calls/unary_call.h"

#include <utility>

#include "server/base/errors.h"
#include "server/base/grpc_status.h"
#include "server/calls/patient_attempt.h"
#include "server/calls/service_context.h"

namespace plumescout::server {
namespace {

void EndStage(const UnaryCall& call, Stage stage, SteadyTime began) {
  call.info().stage_times->Add(stage, absl::FromChrono(SteadyNow() - began));
}

// Of all that was done to a mission when this was made. What keeps the answer does not keep the
// mission.
class Durability final : public Proviso {
 public:
  explicit Durability(const std::shared_ptr<MissionHost>& host)
      : host_(host), journal_(host->shared_journal()), revision_(host->summary().revision) {}

  void Await(Heard heard) const override {
    if (const auto host = host_.lock()) return host->WhenDurable(std::move(heard));
    journal_->WhenDurable(revision_, SteadyTime::max(), std::move(heard));  // closed: it knows
  }
  bool IsOpen() const override { return journal_->is_open(); }

 private:
  const std::weak_ptr<MissionHost> host_;
  const std::shared_ptr<MissionJournal> journal_;
  const std::int64_t revision_;
};

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

void UnaryCall::BeforeAnswer(Look look) {
  absl::MutexLock lock(&mutex_);
  look_ = std::move(look);
}

void UnaryCall::AnswerUnder(const std::shared_ptr<const Proviso>& proviso,
                            const absl::Status& status) {
  Look look;
  {
    absl::MutexLock lock(&mutex_);
    if (std::exchange(answered_, true)) return;
    look.swap(look_);
  }
  if (look) look(status, proviso);
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

void AnswerWhenDurable(const std::shared_ptr<MissionHost>& host,
                       const std::shared_ptr<UnaryCall>& call, const absl::Status& status) {
  if (!status.ok()) return call->Answer(status);
  host->WhenDurable(
      [call, proviso = OnceDurable(host), began = SteadyNow()](const absl::Status& durable) {
        EndStage(*call, Stage::kDurable, began);
        call->AnswerUnder(proviso, durable);
      });
}

std::shared_ptr<const Proviso> OnceDurable(const std::shared_ptr<MissionHost>& host) {
  return std::make_shared<const Durability>(host);
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
