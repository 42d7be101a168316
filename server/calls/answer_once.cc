// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/calls/answer_once.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "proto/convert/field.h"

namespace plumescout::server {
namespace {

constexpr std::size_t kMaxWordLength = 64;

absl::Status CheckRequestId(const std::string& id) {
  const bool is_word = std::all_of(id.begin(), id.end(), [](char c) {
    return absl::ascii_isgraph(static_cast<unsigned char>(c));
  });
  if (is_word && id.size() <= kMaxWordLength) return absl::OkStatus();
  return FieldError("request_id", id, "must be a word of at most 64 characters");
}

// A call that waits for the answer to another one, until it gets that or its caller gives up.
class Waiting {
 public:
  explicit Waiting(std::shared_ptr<UnaryCall> call) : call_(std::move(call)) {}
  // True for the first only, who then answers the call or runs it.
  bool Claim() { return !claimed_.exchange(true); }
  const std::shared_ptr<UnaryCall>& call() const { return call_; }

 private:
  const std::shared_ptr<UnaryCall> call_;
  std::atomic<bool> claimed_ = false;
};

void GiveAnswer(const std::string& answer, google::protobuf::Message* response, UnaryCall& call) {
  const bool whole = response->ParseFromString(answer);
  call.Answer(whole ? absl::OkStatus() : absl::InternalError("an answer was not kept whole"));
}

}  // namespace

RequestKey KeyOf(const UnaryCall& call, const std::string& request_id) {
  return {absl::StrCat(call.caller().tenant, "/", call.caller().name),
          std::string(RowOf(call.info().rpc).method), request_id};
}

absl::Status AnswerOnce(const std::shared_ptr<RequestMemory>& memory, const std::string& request_id,
                        const google::protobuf::Message& request,
                        google::protobuf::Message* response, const std::shared_ptr<UnaryCall>& call,
                        const UnaryCall::Handler& handle) {
  if (request_id.empty()) return handle(call);
  PLUMESCOUT_RETURN_IF_ERROR(CheckRequestId(request_id));
  const RequestKey key = KeyOf(*call, request_id);
  const auto run = [memory, key, response, handle](const std::shared_ptr<UnaryCall>& runner) {
    runner->BeforeAnswer([memory, key, response](const absl::Status& status) {
      memory->Conclude(key,
                       status.ok() ? std::optional(response->SerializeAsString()) : std::nullopt);
    });
    return handle(runner);
  };
  const auto waiting = std::make_shared<Waiting>(call);
  // Before the wait begins: it would outlive a call that is over by then.
  call->WhenCancelled([waiting] {
    if (waiting->Claim()) waiting->call()->Answer(absl::CancelledError("the caller gave up"));
  });
  auto begun =
      memory->Begin(key, std::hash<std::string>()(request.SerializeAsString()),
                    [waiting, response, run](const std::string* answer) {
                      if (!waiting->Claim()) return false;
                      if (answer != nullptr) {
                        GiveAnswer(*answer, response, *waiting->call());
                      } else if (absl::Status status = run(waiting->call()); !status.ok()) {
                        waiting->call()->Answer(status);
                      }
                      return true;
                    });
  if (begun.ok() && !begun->run && !begun->answer) return absl::OkStatus();
  if (!waiting->Claim()) {  // cancelled, and told so
    if (begun.ok() && begun->run) memory->Conclude(key, std::nullopt);
    return absl::OkStatus();
  }
  PLUMESCOUT_RETURN_IF_ERROR(begun.status());
  if (begun->run) return run(call);
  GiveAnswer(*begun->answer, response, *call);
  return absl::OkStatus();
}

}  // namespace plumescout::server
