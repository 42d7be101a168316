// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "absl/strings/str_cat.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {

// A folder of an authority's certificates, made by scripts/certs. Tests run at the root.
class Certificates {
 public:
  explicit Certificates(const std::string& authority = "authority") {
    Make(absl::StrCat("authority ", authority));
  }

  // Runs scripts/certs with these arguments after the folder.
  void Make(const std::string& arguments) const {
    const std::string command = absl::StrCat("scripts/certs ", folder_.path(), " ", arguments);
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
  }
  std::string File(const std::string& name) const { return folder_.File(name); }
  std::string Text(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(File(name)).rdbuf();
    return text.str();
  }

 private:
  TempFolder folder_;
};

}  // namespace plumescout::server
