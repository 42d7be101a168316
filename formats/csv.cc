// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/csv.h"

#include <charconv>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_replace.h"
#include "formats/file_io.h"

namespace plumescout {
namespace {

constexpr char kSeparator[] = ",";
constexpr char kLineEnd[] = "\r\n";  // RFC 4180 section 2

void AppendName(std::string* line, const std::string& name) {
  if (name.find_first_of(",\"\r\n") == std::string::npos) {
    line->append(name);
  } else {
    absl::StrAppend(line, "\"", absl::StrReplaceAll(name, {{"\"", "\"\""}}), "\"");
  }
}

void AppendNumber(std::string* line, double value) {
  if (!std::isfinite(value)) return;
  char digits[32];  // the longest double takes 24
  const std::to_chars_result result = std::to_chars(digits, digits + sizeof(digits), value);
  line->append(digits, result.ptr);
}

}  // namespace

absl::Status WriteCsv(const CsvTable& table, const std::string& path) {
  std::string text = absl::StrJoin(table.columns, kSeparator, AppendName) + kLineEnd;
  for (const std::vector<double>& row : table.rows) {
    if (row.size() != table.columns.size()) {
      return absl::InvalidArgumentError(absl::StrCat(
          path, ": a row of ", row.size(), " values under ", table.columns.size(), " columns"));
    }
    absl::StrAppend(&text, absl::StrJoin(row, kSeparator, AppendNumber), kLineEnd);
  }
  return WriteFile(path, text);
}

}  // namespace plumescout
