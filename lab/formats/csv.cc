// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/formats/csv.h"

#include <charconv>
#include <cmath>
#include <cstddef>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_replace.h"
#include "core/types/status_macros.h"
#include "formats/file_io.h"

namespace plumescout::lab {
namespace {

constexpr char kSeparator[] = ",";
constexpr char kLineEnd[] = "\r\n";  // RFC 4180 section 2

void AppendText(std::string* line, const std::string& name) {
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

absl::Status CheckWidth(const char* what, std::size_t width,
                        const std::vector<std::string>& columns, const std::string& path) {
  if (width == columns.size()) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(path, ": a row of ", width, " ", what, " under ", columns.size(), " columns"));
}

}  // namespace

absl::Status WriteCsv(const CsvTable& table, const std::string& path) {
  const std::size_t labelled = table.label_columns.empty() ? 0 : table.rows.size();
  if (table.labels.size() != labelled) {
    return absl::InvalidArgumentError(
        absl::StrCat(path, ": labels for ", table.labels.size(), " rows of ", labelled));
  }
  std::string text;
  for (const std::string& name : table.label_columns) {
    AppendText(&text, name);
    text += kSeparator;
  }
  absl::StrAppend(&text, absl::StrJoin(table.columns, kSeparator, AppendText), kLineEnd);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    PLUMESCOUT_RETURN_IF_ERROR(CheckWidth("values", table.rows[i].size(), table.columns, path));
    if (labelled > 0) {
      PLUMESCOUT_RETURN_IF_ERROR(
          CheckWidth("labels", table.labels[i].size(), table.label_columns, path));
      for (const std::string& label : table.labels[i]) {
        AppendText(&text, label);
        text += kSeparator;
      }
    }
    absl::StrAppend(&text, absl::StrJoin(table.rows[i], kSeparator, AppendNumber), kLineEnd);
  }
  return WriteFile(path, text);
}

}  // namespace plumescout::lab
