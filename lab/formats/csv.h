// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "absl/status/status.h"

namespace plumescout::lab {

struct CsvTable {
  std::vector<std::string> columns;       // names, with units
  std::vector<std::vector<double>> rows;  // as many values as columns; not finite: not measured
  // Columns of text that come before those; both empty, or a label of each column for each row.
  std::vector<std::string> label_columns = {};
  std::vector<std::vector<std::string>> labels = {};
};

// Writes RFC 4180 with a header line. Numbers are as short as reads back exactly, a value that was
// not measured is an empty field. kInvalidArgument if a row has another length or labels are
// missing; else as WriteFile.
absl::Status WriteCsv(const CsvTable& table, const std::string& path);

}  // namespace plumescout::lab
