// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/access/authenticator.h"

#include <grpc/grpc_security_constants.h>
#include <grpcpp/security/auth_context.h>

#include <utility>

#include "absl/memory/memory.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/strip.h"
#include "core/types/status_macros.h"
#include "server/access/subject.h"
#include "server/base/address.h"

namespace plumescout::server {
namespace {

constexpr char kSubjectKey[] = "x-plumescout-subject";
constexpr char kAuthorizationKey[] = "authorization";
constexpr char kBearer[] = "bearer ";

std::vector<std::string> ValuesOf(const grpc::CallbackServerContext& call, const char* key) {
  std::vector<std::string> values;
  const auto [begin, end] = call.client_metadata().equal_range(key);
  for (auto it = begin; it != end; ++it) {
    values.emplace_back(it->second.data(), it->second.size());
  }
  return values;
}

// A certificate that says nothing of use is as bad as none.
absl::StatusOr<Principal> OfSubject(const std::string& subject) {
  auto principal = PrincipalOfSubject(subject);
  if (principal.ok()) return principal;
  return absl::UnauthenticatedError(absl::StrCat("certificate: ", principal.status().message()));
}

}  // namespace

CallCredentials ReadCredentials(const grpc::CallbackServerContext& call) {
  CallCredentials credentials;
  credentials.peer = call.peer();
  credentials.forwarded_subjects = ValuesOf(call, kSubjectKey);
  credentials.authorizations = ValuesOf(call, kAuthorizationKey);
  const auto context = call.auth_context();
  if (context == nullptr) return credentials;
  const auto subjects = context->FindPropertyValues(GRPC_X509_SUBJECT_PROPERTY_NAME);
  if (!subjects.empty()) {
    credentials.certificate_subject = std::string(subjects[0].data(), subjects[0].size());
  }
  return credentials;
}

Authenticator::Authenticator(const AccessConfig& config, bool allow_anonymous,
                             std::unique_ptr<TokenFile> tokens, Clock clock)
    : trusted_front_(config.trusted_front),
      allow_anonymous_(allow_anonymous),
      tokens_(std::move(tokens)),
      clock_(std::move(clock)) {}

absl::StatusOr<std::shared_ptr<Authenticator>> Authenticator::Make(const AccessConfig& config,
                                                                   bool local, Clock clock) {
  std::unique_ptr<TokenFile> tokens;
  if (!config.tokens_file.empty()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(tokens, TokenFile::Open(config.tokens_file));
  }
  const bool nothing_configured =
      config.tokens_file.empty() && config.client_ca_file.empty() && config.trusted_front.empty();
  const bool allow_anonymous = config.allow_anonymous || (local && nothing_configured);
  return absl::WrapUnique(
      new Authenticator(config, allow_anonymous, std::move(tokens), std::move(clock)));
}

bool Authenticator::IsFront(const CallCredentials& credentials) const {
  if (trusted_front_.empty()) return false;
  if (trusted_front_ == kLocalFront) return IsLocalPeer(credentials.peer);
  if (trusted_front_ == kUnixFront) return IsUnixAddress(credentials.peer);
  if (!credentials.certificate_subject) return false;
  const auto name = CommonNameOf(*credentials.certificate_subject);
  return name.ok() && *name == trusted_front_;
}

absl::StatusOr<Principal> Authenticator::OfToken(
    const std::vector<std::string>& authorizations) const {
  absl::string_view token = authorizations[0];
  if (authorizations.size() > 1 || !absl::StartsWithIgnoreCase(token, kBearer)) {
    return absl::UnauthenticatedError("authorization must be \"Bearer TOKEN\", once");
  }
  token.remove_prefix(sizeof(kBearer) - 1);
  if (tokens_ == nullptr) {
    return absl::UnauthenticatedError("the server knows no tokens (access.tokens_file)");
  }
  return tokens_->Find(token, clock_());
}

absl::StatusOr<Principal> Authenticator::Identify(const CallCredentials& credentials) const {
  const bool from_front = IsFront(credentials);
  const std::vector<std::string>& forwarded = credentials.forwarded_subjects;
  if (!forwarded.empty() && !from_front) {
    return absl::UnauthenticatedError(
        absl::StrCat(kSubjectKey, " is taken from the trusted front only"));
  }
  if (!credentials.authorizations.empty()) return OfToken(credentials.authorizations);
  if (forwarded.size() > 1) {
    return absl::UnauthenticatedError(absl::StrCat("several ", kSubjectKey));
  }
  if (!forwarded.empty()) return OfSubject(forwarded[0]);
  // The front's own certificate says nothing about who calls.
  if (credentials.certificate_subject && !from_front) {
    return OfSubject(*credentials.certificate_subject);
  }
  if (allow_anonymous_) return Principal{};
  return absl::UnauthenticatedError("neither a token nor a client certificate came with the call");
}

}  // namespace plumescout::server
