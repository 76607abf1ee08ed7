// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace bench {

struct Options {
  std::vector<std::ptrdiff_t> advection_cells{64, 128};
  std::vector<std::ptrdiff_t> cells_2d{64, 128, 256, 512};
  std::vector<std::ptrdiff_t> cells_3d{32, 64, 96};
  /// Only methods whose names contain this.
  std::string only;
  /// Folder of the fields that write_fields() left there, and of what scripts/run_scikit_fmm.py made of them.
  std::string fields;
};

/// Rows of the table of results.
using Rows = nlohmann::json;

/// Enright's test by every policy of advection.
void run_advections(const Options& options, Rows& rows);
/// Every reinitialisation of a badly scaled ellipse or ellipsoid.
void run_reinitialisations(const Options& options, Rows& rows);
/// What they start from, for programs in other languages: one file of doubles for each lattice, axis 0 fastest, and a
/// list of them.
void write_fields(const Options& options);

}  // namespace bench
