// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/access/server_credentials.h"

#include <grpcpp/security/tls_certificate_provider.h>
#include <grpcpp/security/tls_credentials_options.h>
#include <openssl/err.h>
#include <openssl/ssl.h>

#include <string>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"

namespace plumescout::server {
namespace {

constexpr unsigned int kReload_s = 1;

// What OpenSSL says of its last failure.
std::string WhyNot() {
  const unsigned long code = ERR_get_error();
  ERR_clear_error();
  const char* reason = ERR_reason_error_string(code);
  return reason == nullptr ? "unknown error" : reason;
}

absl::Status BadFile(absl::string_view option, const std::string& path) {
  return absl::InvalidArgumentError(absl::StrCat(option, " = ", path, ": ", WhyNot()));
}

absl::Status CheckFiles(const AccessConfig& config) {
  const std::unique_ptr<SSL_CTX, void (*)(SSL_CTX*)> context(SSL_CTX_new(TLS_server_method()),
                                                             SSL_CTX_free);
  SSL_CTX* tls = context.get();
  // Nobody is there to be asked for a passphrase.
  SSL_CTX_set_default_passwd_cb(tls, [](char*, int, int, void*) { return 0; });
  if (SSL_CTX_use_certificate_chain_file(tls, config.tls_certificate_file.c_str()) != 1) {
    return BadFile("access.tls_certificate_file", config.tls_certificate_file);
  }
  if (SSL_CTX_use_PrivateKey_file(tls, config.tls_key_file.c_str(), SSL_FILETYPE_PEM) != 1 ||
      SSL_CTX_check_private_key(tls) != 1) {
    return BadFile("access.tls_key_file", config.tls_key_file);
  }
  if (!config.client_ca_file.empty() &&
      SSL_CTX_load_verify_file(tls, config.client_ca_file.c_str()) != 1) {
    return BadFile("access.client_ca_file", config.client_ca_file);
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<std::shared_ptr<grpc::ServerCredentials>> MakeServerCredentials(
    const AccessConfig& config) {
  if (config.tls_certificate_file.empty()) return grpc::InsecureServerCredentials();
  PLUMESCOUT_RETURN_IF_ERROR(CheckFiles(config));
  grpc::experimental::TlsServerCredentialsOptions options(
      std::make_shared<grpc::experimental::FileWatcherCertificateProvider>(
          config.tls_key_file, config.tls_certificate_file, config.client_ca_file, kReload_s));
  options.watch_identity_key_cert_pairs();
  if (!config.client_ca_file.empty()) {
    options.watch_root_certs();
    options.set_cert_request_type(config.require_client_certificate
                                      ? GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY
                                      : GRPC_SSL_REQUEST_CLIENT_CERTIFICATE_AND_VERIFY);
  }
  return grpc::experimental::TlsServerCredentials(options);
}

}  // namespace plumescout::server
