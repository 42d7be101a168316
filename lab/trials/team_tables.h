// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "lab/formats/csv.h"
#include "lab/report/text_table.h"
#include "lab/trials/study.h"
#include "lab/trials/team_rows.h"

namespace plumescout::lab {

// What studies of teams tell of buildings of one size.

// "12.3 %"
std::string Percent(double share);

// How many times sooner each row is there than row 0, whose teams are one robot, and what that
// costs.
TextTable SpeedTable(const SizeResult& result);
// Who was in whose way.
TextTable TrafficTable(const SizeResult& result);

// The same as figures and key numbers, named SIZE_ROW_FIGURE.
void AddNumbers(const SizeResult& result, Study& study);
void AddTrafficNumbers(const SizeResult& result, std::size_t row, Study& study);

// Whether the maps know how far off they are; figures are named as above.
void AddCalibration(const SizeResult& result, Study& study);

// Every trial, after those that are in the table.
void AddRows(const SizeResult& result, CsvTable& table);

}  // namespace plumescout::lab
