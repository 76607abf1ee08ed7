// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <cambium/levelset/surface.hpp>

namespace tumour {

/// Name and values, one for each vertex or node.
struct Named {
  std::string name;
  std::vector<double> values;
};

/// A file that appears as a whole or not at all: written beside its place, synced, moved.
/// \throws cambium::FileError
void write_whole(const std::filesystem::path& path, const std::string& text);

/// Closed curves: component,x,y and the data, point after point. \throws cambium::FileError
void write_curves(const std::filesystem::path& path, const cambium::Surface<2>& surface,
                  const std::vector<Named>& data);

}  // namespace tumour
