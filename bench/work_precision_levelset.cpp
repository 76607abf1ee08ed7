// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Error against time of level sets: Enright's deformation of a ball by every policy of advection, and the distance and
// curvature that every reinitialisation makes of a badly scaled ellipsoid; OpenVDB beside them where it was found.
// Times are processor times of one thread, those of measuring not among them.
//
// scripts/bench_work_precision_levelset builds and runs it, scikit-fmm between the two calls, and draws the charts:
//     work_precision_levelset --fields FOLDER --write-fields
//     scripts/run_scikit_fmm.py FOLDER
//     work_precision_levelset --fields FOLDER --json raw.json
//     scripts/draw_work_precision_levelset.py raw.json
#include <CLI/CLI.hpp>
#include <cstdio>

#include "levelset/options.hpp"
#include "support/command.hpp"

int main(int argc, char** argv) {
  bench::Options options;
  std::string json;
  bool write = false;
  bool quick = false;
  CLI::App app("Error against time of advection and reinitialisation of level sets");
  app.add_option("--advection", options.advection_cells, "cells along an axis of Enright's test (0: leave it out)");
  app.add_option("--cells-2d", options.cells_2d, "cells along an axis of reinitialisation in 2D (0: leave it out)");
  app.add_option("--cells-3d", options.cells_3d, "cells along an axis of reinitialisation in 3D (0: leave it out)");
  app.add_option("--only", options.only, "only methods whose names contain this");
  app.add_option("--fields", options.fields, "folder of fields for, and distances of, scripts/run_scikit_fmm.py");
  app.add_flag("--write-fields", write, "write the fields to that folder and do nothing else");
  app.add_option("--json", json, "write the results to this file");
  app.add_flag("--quick", quick, "coarse lattices, to see that it runs");
  CLI11_PARSE(app, argc, argv);
  if (quick) {
    options.advection_cells = {24};
    options.cells_2d = {32};
    options.cells_3d = {24};
  }
  for (auto* cells : {&options.advection_cells, &options.cells_2d, &options.cells_3d}) std::erase(*cells, 0);
  if (write) {
    if (options.fields.empty()) {
      std::fprintf(stderr, "--write-fields needs the folder to write to: --fields FOLDER\n");
      return 1;
    }
    bench::write_fields(options);
    return 0;
  }

  bench::Rows advection = bench::Rows::array();
  bench::Rows reinitialisation = bench::Rows::array();
  bench::run_reinitialisations(options, reinitialisation);
  bench::run_advections(options, advection);
  if (!json.empty()) {
    const nlohmann::json all{
        {"compiler", __VERSION__}, {"advection", advection}, {"reinitialisation", reinitialisation}};
    bench::write_json(json, all);
  }
  return 0;
}
