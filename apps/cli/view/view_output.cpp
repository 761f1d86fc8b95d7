// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/view/view_output.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "apps/command/output.hpp"
#include "odosplat/io/image/picture_file.hpp"

namespace odosplat::apps {

CLI::App* add_view_kind(CLI::App* parent, Common& common, const char* name, const char* help, ViewOutputFlags& flags) {
  CLI::App* command = add_command(*parent, common, name, help);
  command->add_option("--out", flags.out, "picture to write: .png, .jpg, .pdf or .svg")->type_name("FILE")->required();
  command->add_option("--size", flags.size, "WIDTHxHEIGHT of the picture [px]")
      ->type_name("WxH")
      ->default_str("as the figure needs");
  return command;
}

void save_picture(const ViewOutputFlags& flags, const cv::Mat3b& picture) {
  write_picture(flags.out, picture);
  print("%s: %dx%d\n", flags.out.c_str(), picture.cols, picture.rows);
}

}  // namespace odosplat::apps
