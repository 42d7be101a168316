// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/credentials.h"

#include <grpcpp/channel.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <grpcpp/security/tls_certificate_provider.h>
#include <grpcpp/security/tls_credentials_options.h>
#include <grpcpp/support/channel_arguments.h>
#include <grpcpp/support/client_interceptor.h>

#include <fstream>
#include <utility>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"

namespace plumescout::client {
namespace {

namespace tls = grpc::experimental;

constexpr unsigned int kReload_s = 10;
constexpr char kAuthorizationKey[] = "authorization";

std::string FirstLine(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return std::string(absl::StripAsciiWhitespace(line));
}

absl::Status CheckReadable(const std::string& path) {
  if (path.empty() || std::ifstream(path).good()) return absl::OkStatus();
  return absl::NotFoundError(absl::StrCat(path, " cannot be read"));
}

// Adds the token to a call before it goes out.
class TokenInterceptor final : public tls::Interceptor {
 public:
  explicit TokenInterceptor(const std::string& token_file) : token_file_(token_file) {}

  void Intercept(tls::InterceptorBatchMethods* methods) override {
    if (methods->QueryInterceptionHookPoint(
            tls::InterceptionHookPoints::PRE_SEND_INITIAL_METADATA)) {
      methods->GetSendInitialMetadata()->emplace(kAuthorizationKey,
                                                 absl::StrCat("Bearer ", FirstLine(token_file_)));
    }
    methods->Proceed();
  }

 private:
  const std::string token_file_;
};

class TokenInterceptorFactory final : public tls::ClientInterceptorFactoryInterface {
 public:
  explicit TokenInterceptorFactory(std::string token_file) : token_file_(std::move(token_file)) {}

  tls::Interceptor* CreateClientInterceptor(tls::ClientRpcInfo*) override {
    return new TokenInterceptor(token_file_);  // gRPC owns it
  }

 private:
  const std::string token_file_;
};

std::shared_ptr<grpc::ChannelCredentials> MakeChannelCredentials(const Credentials& credentials) {
  if (credentials.tls_ca_file.empty()) return grpc::InsecureChannelCredentials();
  tls::TlsChannelCredentialsOptions options;
  options.set_certificate_provider(std::make_shared<tls::FileWatcherCertificateProvider>(
      credentials.tls_key_file, credentials.tls_certificate_file, credentials.tls_ca_file,
      kReload_s));
  options.watch_root_certs();
  if (!credentials.tls_certificate_file.empty()) options.watch_identity_key_cert_pairs();
  return tls::TlsCredentials(options);
}

}  // namespace

absl::Status CheckCredentials(const Credentials& credentials) {
  if (credentials.tls_certificate_file.empty() != credentials.tls_key_file.empty()) {
    return absl::InvalidArgumentError("a certificate and its key go together");
  }
  if (credentials.tls_ca_file.empty() && !credentials.tls_certificate_file.empty()) {
    return absl::InvalidArgumentError("a certificate needs the authority of the server's");
  }
  PLUMESCOUT_RETURN_IF_ERROR(CheckReadable(credentials.tls_ca_file));
  PLUMESCOUT_RETURN_IF_ERROR(CheckReadable(credentials.tls_certificate_file));
  PLUMESCOUT_RETURN_IF_ERROR(CheckReadable(credentials.tls_key_file));
  PLUMESCOUT_RETURN_IF_ERROR(CheckReadable(credentials.token_file));
  if (credentials.token_file.empty() || !FirstLine(credentials.token_file).empty()) {
    return absl::OkStatus();
  }
  return absl::InvalidArgumentError(absl::StrCat(credentials.token_file, " holds no token"));
}

std::shared_ptr<grpc::Channel> MakeChannel(const std::string& target,
                                           const Credentials& credentials,
                                           const grpc::ChannelArguments& arguments) {
  const bool usable = CheckCredentials(credentials).ok();
  std::vector<std::unique_ptr<tls::ClientInterceptorFactoryInterface>> interceptors;
  if (!credentials.token_file.empty()) {
    interceptors.push_back(std::make_unique<TokenInterceptorFactory>(credentials.token_file));
  }
  return tls::CreateCustomChannelWithInterceptors(
      target, usable ? MakeChannelCredentials(credentials) : nullptr, arguments,
      std::move(interceptors));
}

}  // namespace plumescout::client
