// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>

namespace command_line {

/// A check of an option that names a file to be written: known before the work begins, not when it is done.
inline CLI::Validator writable_file() {
  const auto complaint = [](const std::string& path) {
    if (std::ofstream(path, std::ios::app)) return std::string();
    return "cannot write " + path + ": check that its folder exists and may be written to";
  };
  return {complaint, ""};
}

/// Writes a text to a file. \throws std::runtime_error if it does not get there as a whole
inline void write_text(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  file << text << std::endl;
  if (!file) throw std::runtime_error("cannot write " + path + ": check that its folder exists and has space left");
}

/// What main returns for an error that ends the program, having said what it is.
inline int failed(const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}

}  // namespace command_line
