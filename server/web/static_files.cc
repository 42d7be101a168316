// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/web/static_files.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"

namespace plumescout::server {
namespace {

namespace fs = std::filesystem;

constexpr char kIndex[] = "/index.html";
// Names of assets have a hash of the content in them; those of others do not.
constexpr char kAssets[] = "/assets/";
constexpr char kForEver[] = "public, max-age=31536000, immutable";
constexpr char kAskAgain[] = "no-cache";

const std::map<std::string, std::string>& Types() {
  static const auto& types =
      *new std::map<std::string, std::string>{{".html", "text/html; charset=utf-8"},
                                              {".js", "text/javascript; charset=utf-8"},
                                              {".css", "text/css; charset=utf-8"},
                                              {".json", "application/json"},
                                              {".svg", "image/svg+xml"},
                                              {".png", "image/png"},
                                              {".txt", "text/plain; charset=utf-8"},
                                              {".ico", "image/x-icon"}};
  return types;
}

bool IsHidden(const fs::path& relative) {
  for (const fs::path& part : relative) {
    if (absl::StartsWith(part.string(), ".")) return true;
  }
  return false;
}

}  // namespace

absl::StatusOr<StaticFiles> StaticFiles::Load(const std::string& folder) {
  StaticFiles files;
  std::size_t bytes = 0;
  std::error_code error;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    const auto type = Types().find(it->path().extension().string());
    const fs::path relative = it->path().lexically_relative(folder);
    if (type == Types().end() || IsHidden(relative) || !it->is_regular_file(error)) continue;
    std::ifstream stream(it->path(), std::ios::binary);
    std::string content(std::istreambuf_iterator<char>(stream), {});
    bytes += content.size();
    const std::string path = absl::StrCat("/", relative.generic_string());
    files.files_[path] = {type->second, absl::StartsWith(path, kAssets) ? kForEver : kAskAgain,
                          std::move(content)};
    if (files.files_.size() > kMaxFiles || bytes > kMaxBytes) {
      return absl::ResourceExhaustedError(absl::StrCat("console.folder = ", folder,
                                                       " holds more than ", kMaxFiles, " files or ",
                                                       kMaxBytes, " bytes"));
    }
  }
  if (files.Find(kIndex) != nullptr) return files;
  return absl::InvalidArgumentError(
      absl::StrCat("console.folder = ", folder, " has no index.html: scripts/console makes it"));
}

absl::StatusOr<StaticFiles> StaticFiles::LoadOrInstalled(const std::string& folder,
                                                         const std::string& program) {
  if (!folder.empty()) return Load(folder);
  const fs::path installed =
      fs::path(program).parent_path().parent_path() / "share/plumescout/console";
  std::error_code error;
  if (!fs::is_directory(installed, error)) return StaticFiles();
  return Load(installed.string());
}

const StaticFile* StaticFiles::Find(const std::string& path) const {
  const auto it = files_.find(path == "/" ? kIndex : path);
  return it == files_.end() ? nullptr : &it->second;
}

}  // namespace plumescout::server
