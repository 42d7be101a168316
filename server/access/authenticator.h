// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/server_context.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "server/access/principal.h"
#include "server/access/token_file.h"
#include "server/config/config.h"

namespace plumescout::server {

// What a call brings along that says who makes it.
struct CallCredentials {
  std::string peer = {};                                // its address as gRPC writes it
  std::vector<std::string> forwarded_subjects = {};     // values of x-plumescout-subject
  std::vector<std::string> authorizations = {};         // values of authorization
  std::optional<std::string> certificate_subject = {};  // of a certificate that was verified
};

CallCredentials ReadCredentials(const grpc::CallbackServerContext& call);

// Says who calls, in this order: whoever has the bearer token; whom the trusted front has verified;
// whoever has the certificate; nobody in particular, where that is allowed. Credentials that are
// wrong are refused: nothing else is tried in their place. Thread-safe.
class Authenticator {
 public:
  using Clock = std::function<absl::Time()>;

  // `local`: callers of this machine alone reach the server, and where nothing is configured that
  // could tell them apart, all are anonymous admins. Refuses a file of tokens that cannot be read.
  static absl::StatusOr<std::shared_ptr<Authenticator>> Make(const AccessConfig& config, bool local,
                                                             Clock clock = absl::Now);

  // kUnauthenticated saying why.
  absl::StatusOr<Principal> Identify(const CallCredentials& credentials) const;

 private:
  Authenticator(const AccessConfig& config, bool allow_anonymous, std::unique_ptr<TokenFile> tokens,
                Clock clock);

  bool IsFront(const CallCredentials& credentials) const;
  absl::StatusOr<Principal> OfToken(const std::vector<std::string>& authorizations) const;

  const std::string trusted_front_;
  const bool allow_anonymous_;
  const std::unique_ptr<TokenFile> tokens_;  // null: there are none
  const Clock clock_;
};

}  // namespace plumescout::server
