// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/postgres_hosts.h"

#include <libpq-fe.h>

#include <algorithm>
#include <cstddef>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "absl/strings/string_view.h"

namespace plumescout::server {
namespace {

// An empty list has one empty place.
using Places = std::vector<std::string>;

const std::string& PlaceOf(const Places& places, std::size_t index) {
  return places.size() == 1 ? places.front() : places[index];
}

}  // namespace

absl::StatusOr<std::vector<PostgresHost>> PostgresHosts(const std::string& url) {
  PQconninfoOption* const options = PQconninfoParse(url.c_str(), nullptr);
  if (options == nullptr) {
    return absl::InvalidArgumentError("the URL of the database cannot be read");
  }
  Places hosts = {""};
  Places addresses = {""};
  Places ports = {""};
  for (const PQconninfoOption* option = options; option->keyword != nullptr; ++option) {
    const absl::string_view keyword = option->keyword;
    const absl::string_view value = option->val == nullptr ? "" : option->val;
    if (keyword == "host") hosts = absl::StrSplit(value, ',');
    if (keyword == "hostaddr") addresses = absl::StrSplit(value, ',');
    if (keyword == "port") ports = absl::StrSplit(value, ',');
  }
  PQconninfoFree(options);
  const std::size_t count = std::max(hosts.size(), addresses.size());
  for (const std::size_t size : {hosts.size(), addresses.size(), ports.size()}) {
    if (size == 1 || size == count) continue;
    return absl::InvalidArgumentError(absl::StrCat("the URL of the database has ", hosts.size(),
                                                   " hosts, ", addresses.size(), " addresses and ",
                                                   ports.size(), " ports"));
  }
  std::vector<PostgresHost> all;
  for (std::size_t i = 0; i < count; ++i) {
    all.push_back({PlaceOf(hosts, i), PlaceOf(addresses, i), PlaceOf(ports, i)});
  }
  return all;
}

}  // namespace plumescout::server
