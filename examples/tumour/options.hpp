// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <cambium/models/tumour/parameters.hpp>

#include "checkpoint.hpp"

namespace tumour {

/// What the command line and the configuration file say of a run.
struct Options {
  std::string scene = "none";
  int dim = 2;
  int cells = 128;                                                 ///< along a side of the box
  double box = 12.0;                                               ///< length of a side
  std::string shape = "ellipsoid:0.1,2";                           ///< see shape_of()
  cambium::TumourParameters parameters = {.necrotic_limit = 0.0};  ///< N = 0: no necrosis
  std::string outside = "free-space";
  double courant = 0.25;
  std::vector<double> at = {1.0};  ///< times of pictures and files; the run ends at the last one
  std::string out = "out/tumour";
  std::string json = {};
  int threads = 0;
  bool page = true;
  bool dry_run = false;
  bool list = false;
  bool smoke = false;
  double checkpoint = 60.0;     ///< seconds on the wall between checkpoints
  std::string resume = {};      ///< checkpoint to go on from
  std::string make_image = {};  ///< file for a label image of the shape

  friend bool operator==(const Options&, const Options&) = default;
};

/// Reads the command line: what it names counts before what the configuration file does, that before the scene. With
/// --resume, what a run was given that is gone on with counts instead of these two.
/// \param saved  becomes what --resume names; it may differ in its times, folder, threads and checkpoints alone
/// \param configuration  everything that the run was given, as a file that --config reads
/// \throws CLI::ParseError, ValueError for what makes no sense, CheckpointError
Options read_options(int argc, const char* const* argv, std::string& configuration, std::optional<Checkpoint>& saved);

}  // namespace tumour
