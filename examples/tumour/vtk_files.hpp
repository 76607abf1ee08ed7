// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include <cambium/core/lattice.hpp>
#include <cambium/levelset/surface.hpp>

#include "files.hpp"

namespace tumour {

/// A surface with data at its vertices for ParaView (VTP). \throws cambium::FileError
void write_surface(const std::filesystem::path& path, const cambium::Surface<3>& surface,
                   const std::vector<Named>& data);
/// Values at the nodes of a lattice for ParaView (VTI). \throws cambium::FileError
template <int D>
void write_fields(const std::filesystem::path& path, const cambium::Lattice<D>& lattice,
                  const std::vector<Named>& data);

}  // namespace tumour
