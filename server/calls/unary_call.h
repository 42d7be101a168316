// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/server_context.h>
#include <grpcpp/support/server_callback.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "absl/synchronization/mutex.h"
#include "core/belief/belief.h"
#include "server/base/fair_pool.h"
#include "server/base/request_memory.h"
#include "server/calls/door.h"
#include "server/missions/mission_host.h"

namespace plumescout::server {

struct ServiceContext;

// A unary call from the door to its answer, now or later, from any thread. The first answer counts.
// gRPC never stops a server that owes one, so a call that everybody has let go of is answered with
// UNAVAILABLE: it stood in a queue that is no more.
class UnaryCall final : public grpc::ServerUnaryReactor {
 public:
  // Answers, or sees to it that somebody will; an error is the answer.
  using Handler = std::function<absl::Status(const std::shared_ptr<UnaryCall>&)>;

  // The reactor owns itself until gRPC is done with it. Requests and responses live until the
  // answer is given. `handle` is called again, perhaps later, if the mission is RECOVERING (see
  // AttemptPatiently).
  static UnaryCall* Start(const ServiceContext& context, Rpc rpc, grpc::CallbackServerContext* call,
                          Handler handle);

  const CallInfo& info() const { return visit_.info(); }
  const Principal& caller() const { return visit_.caller(); }
  bool is_cancelled() const ABSL_LOCKS_EXCLUDED(mutex_);

  // `stop` is called when the caller gives up, at once if it has. Must not block. One at a time.
  void WhenCancelled(std::function<void()> stop) ABSL_LOCKS_EXCLUDED(mutex_);
  // `look` is called, once, when the answer is given and the response is whole, on the thread that
  // gives it. Must not block. One at a time.
  using Look =
      std::function<void(const absl::Status& status, const std::shared_ptr<const Proviso>&)>;
  void BeforeAnswer(Look look) ABSL_LOCKS_EXCLUDED(mutex_);
  void Answer(const absl::Status& status) { AnswerUnder(nullptr, status); }
  // With what `proviso` said. All was done that the response tells of, which is whole.
  void AnswerUnder(const std::shared_ptr<const Proviso>& proviso, const absl::Status& status)
      ABSL_LOCKS_EXCLUDED(mutex_);

  void OnCancel() override ABSL_LOCKS_EXCLUDED(mutex_);
  void OnDone() override;

 private:
  std::shared_ptr<UnaryCall> self_;  // until OnDone
  Visit visit_;

  mutable absl::Mutex mutex_;
  bool cancelled_ ABSL_GUARDED_BY(mutex_) = false;
  bool answered_ ABSL_GUARDED_BY(mutex_) = false;
  std::function<void()> stop_ ABSL_GUARDED_BY(mutex_);
  Look look_ ABSL_GUARDED_BY(mutex_);
};

// Answers a call whose command was dropped.
inline MissionHost::OnDropped Refusal(std::shared_ptr<UnaryCall> call) {
  return [call = std::move(call)](const absl::Status& status) { call->Answer(status); };
}

// Has the mission's writer run the command of a call, or answers it if the command is dropped.
absl::Status PostFor(const std::shared_ptr<UnaryCall>& call, MissionHost& host,
                     MissionHost::Task command);

// Answers a call with an error at once; with OK when all that was done to the mission so far is
// durable, or with an error if it does not become so. A caller that gives up is not waited for
// less: what is done is remembered for when it asks again, also if that is not durable in time.
// From any thread.
void AnswerWhenDurable(const std::shared_ptr<MissionHost>& host,
                       const std::shared_ptr<UnaryCall>& call, const absl::Status& status);
// That all that was done to the mission so far is durable.
std::shared_ptr<const Proviso> OnceDurable(const std::shared_ptr<MissionHost>& host);

// As whom a call waits for a thread: callers of one tenant take turns, and their missions.
inline FairKey TurnOf(const CallInfo& call, absl::string_view mission) {
  return {call.account, std::string(mission), call.caller.tenant};
}
// Answers with what the task says, which runs when it is the caller's turn, unless it has given up
// by then. An error is for the caller to answer with.
absl::Status AnswerInTurn(const std::shared_ptr<UnaryCall>& call, absl::string_view mission,
                          FairPool* pool, std::function<absl::Status()> task);

// Answers a call with what `read` makes of a belief. It runs on `pool`: neither the mission's
// writer nor a search waits for it. The wait for the belief ends with the call. An error is for the
// caller to answer with.
absl::Status AnswerFromBelief(const std::shared_ptr<MissionHost>& host, FairPool* pool,
                              const std::shared_ptr<UnaryCall>& call, BeliefWish wish,
                              std::function<absl::Status(const Belief&)> read);

}  // namespace plumescout::server
