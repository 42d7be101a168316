// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/config/command_line.h"

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "server/base/version.h"
#include "server/config/config_file.h"
#include "server/config/option_help.h"

namespace plumescout::server {
namespace {

struct Flags {
  std::string config_path;
  std::string listen;
  std::string log_format;
  std::string store;
  std::string node;
  std::string data;
  std::string record;
  std::string http;
  std::string http_root;
  std::vector<std::string> settings;  // KEY=VALUE
};

void Declare(Flags& flags, CLI::App& app) {
  app.add_option("-c,--config", flags.config_path, "YAML file with any of the options below")
      ->type_name("FILE");
  app.add_option("-l,--listen", flags.listen, "address and port to serve on; port 0: any free one")
      ->type_name("HOST:PORT");
  app.add_option("--log-format", flags.log_format, "how log lines are written")
      ->type_name("text|json");
  app.add_option("--data", flags.data, "folder where missions are kept")->type_name("DIR");
  app.add_option(
         "--store", flags.store,
         "how missions are kept: in a folder, in memory only, or in a database that several "
         "servers share")
      ->type_name("sqlite|none|postgresql://USER@HOST:PORT/DATABASE");
  app.add_option("--node", flags.node, "name of this server among those that share a database")
      ->type_name("NAME");
  app.add_option("--record", flags.record, "folder where missions are recorded as MCAP files")
      ->type_name("DIR");
  app.add_option("--http", flags.http, "address and port of the console; port 0: any free one")
      ->type_name("HOST:PORT");
  app.add_option("--http-root", flags.http_root, "folder of the console's pages")->type_name("DIR");
  app.add_option("-s,--set", flags.settings, "sets one option, over the file; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.set_version_flag("--version", absl::StrCat("plumescout-server ", kVersion));
}

absl::Status SetStore(const std::string& store, ConfigBuilder& builder) {
  // A URL with a slip in it is not repeated either: see Validate.
  const bool is_url = store.starts_with("postgres") && store != kPostgresqlStore;
  if (!is_url) return builder.Set("store.engine", store);
  PLUMESCOUT_RETURN_IF_ERROR(builder.Set("store.engine", kPostgresqlStore));
  return builder.Set("store.url", store);
}

absl::StatusOr<ServerConfig> BuildConfig(const Flags& flags) {
  ConfigBuilder builder;
  PLUMESCOUT_RETURN_IF_ERROR(builder.Set("store.engine", ProgramDefaults().store.engine));
  if (!flags.config_path.empty()) PLUMESCOUT_RETURN_IF_ERROR(builder.AddFile(flags.config_path));
  for (const std::string& setting : flags.settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) {
      return absl::InvalidArgumentError(absl::StrCat("--set ", setting, ": must be KEY=VALUE"));
    }
    PLUMESCOUT_RETURN_IF_ERROR(builder.Set(setting.substr(0, equals), setting.substr(equals + 1)));
  }
  if (!flags.listen.empty()) PLUMESCOUT_RETURN_IF_ERROR(builder.Set("listen", flags.listen));
  if (!flags.log_format.empty()) {
    PLUMESCOUT_RETURN_IF_ERROR(builder.Set("observe.log_format", flags.log_format));
  }
  if (!flags.data.empty()) PLUMESCOUT_RETURN_IF_ERROR(builder.Set("store.folder", flags.data));
  if (!flags.store.empty()) PLUMESCOUT_RETURN_IF_ERROR(SetStore(flags.store, builder));
  if (!flags.node.empty()) PLUMESCOUT_RETURN_IF_ERROR(builder.Set("store.node", flags.node));
  if (!flags.record.empty()) PLUMESCOUT_RETURN_IF_ERROR(builder.Set("record.folder", flags.record));
  if (!flags.http.empty()) PLUMESCOUT_RETURN_IF_ERROR(builder.Set("console.listen", flags.http));
  if (!flags.http_root.empty()) {
    PLUMESCOUT_RETURN_IF_ERROR(builder.Set("console.folder", flags.http_root));
  }
  return builder.Build();
}

}  // namespace

absl::StatusOr<CommandLine> ReadCommandLine(int argc, const char* const* argv) {
  CLI::App app("Serves gas-mapping missions to robots: plumescout.v1 over gRPC.",
               "plumescout-server");
  Flags flags;
  Declare(flags, app);
  app.footer(OptionHelp);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return CommandLine{{}, app.help()};
  } catch (const CLI::CallForVersion&) {
    return CommandLine{{}, app.version() + "\n"};
  } catch (const CLI::ParseError& error) {
    return absl::InvalidArgumentError(error.what());
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(ServerConfig config, BuildConfig(flags));
  return CommandLine{std::move(config), std::nullopt};
}

}  // namespace plumescout::server
