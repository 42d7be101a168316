// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/calls/answer_once.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "server/base/errors.h"

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

// A call with a request id on its way to an answer: its own, or that of an equal one.
class OneOfEquals : public std::enable_shared_from_this<OneOfEquals> {
 public:
  struct Parts {
    std::shared_ptr<RequestMemory> memory;
    RequestKey key;
    std::uint64_t fingerprint = 0;
    google::protobuf::Message* response = nullptr;
    UnaryCall::Handler handle;
  };
  OneOfEquals(std::shared_ptr<UnaryCall> call, Parts parts)
      : call_(std::move(call)), parts_(std::move(parts)) {}

  // An error is for the caller to answer with.
  absl::Status Begin() {
    auto begun = parts_.memory->Begin(
        parts_.key, parts_.fingerprint,
        [self = shared_from_this()](const KeptAnswer* answer) { return self->Hear(answer); });
    PLUMESCOUT_RETURN_IF_ERROR(begun.status());
    if (begun->answer) Take(*begun->answer);
    if (!begun->run) return absl::OkStatus();
    if (Claim()) return Run();
    parts_.memory->Conclude(parts_.key, std::nullopt);  // cancelled, and told so
    return absl::OkStatus();
  }

  void GiveUp() {
    if (Claim()) call_->Answer(GivenUp());
  }

 private:
  // True for the first only, who then answers the call or runs it.
  bool Claim() { return !claimed_.exchange(true); }

  // Of an equal call. False if we are not there any more.
  bool Hear(const KeptAnswer* answer) {
    if (answer != nullptr) {
      Take(*answer);
      return true;
    }
    if (!Claim()) return false;
    if (const absl::Status status = Run(); !status.ok()) call_->Answer(status);
    return true;
  }

  void Take(const KeptAnswer& answer) {
    if (answer.proviso == nullptr) return Give(answer.bytes);
    answer.proviso->Await([self = shared_from_this(), answer](const absl::Status& came_true) {
      self->TakeAfter(answer, came_true);
    });
  }

  void TakeAfter(const KeptAnswer& answer, const absl::Status& came_true) {
    if (!came_true.ok() && answer.proviso->IsOpen()) {
      if (Claim()) call_->Answer(came_true);
      return;
    }
    parts_.memory->Settle(parts_.key, answer.proviso.get(), came_true.ok());
    if (came_true.ok()) return Give(answer.bytes);
    if (const absl::Status status = Begin(); !status.ok()) call_->Answer(status);
  }

  void Give(const std::string& answer) {
    if (!Claim()) return;
    const bool whole = parts_.response->ParseFromString(answer);
    call_->Answer(whole ? absl::OkStatus() : absl::InternalError("an answer was not kept whole"));
  }

  absl::Status Run() {
    call_->BeforeAnswer([parts = parts_](const absl::Status& status,
                                         const std::shared_ptr<const Proviso>& proviso) {
      const bool may_come_true = !status.ok() && proviso != nullptr && proviso->IsOpen();
      std::optional<KeptAnswer> kept;
      if (status.ok() || may_come_true) {
        kept = KeptAnswer{parts.response->SerializeAsString(), may_come_true ? proviso : nullptr};
      }
      parts.memory->Conclude(parts.key, std::move(kept));
    });
    return parts_.handle(call_);
  }

  const std::shared_ptr<UnaryCall> call_;
  const Parts parts_;
  std::atomic<bool> claimed_ = false;
};

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
  const auto one = std::make_shared<OneOfEquals>(
      call,
      OneOfEquals::Parts{memory, KeyOf(*call, request_id),
                         std::hash<std::string>()(request.SerializeAsString()), response, handle});
  // Before the wait begins: it would outlive a call that is over by then.
  call->WhenCancelled([one] { one->GiveUp(); });
  return one->Begin();
}

}  // namespace plumescout::server
