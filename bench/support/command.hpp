// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace bench {

/// \throws std::runtime_error if the file cannot be written as a whole
inline void write_json(const std::string& path, const nlohmann::json& results) {
  std::ofstream file(path);
  file << results.dump(1) << std::endl;
  if (!file) throw std::runtime_error("cannot write " + path + ": check that its folder exists and has space left");
}

/// The command line of a program that writes its results as JSON and has a quick variant.
struct Command {
  explicit Command(const std::string& what) : app(what) {
    app.add_option("--json", json, "write the results to this file");
    app.add_flag("--quick", quick, "coarse lattices, to see that it runs");
  }
  void write(const nlohmann::json& results) const {
    if (!json.empty()) write_json(json, results);
  }

  CLI::App app;
  std::string json;
  bool quick = false;
};

}  // namespace bench
