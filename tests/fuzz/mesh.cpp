// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Any bytes as a mesh of each kind: a body or a typed error.
#include "mesh_file.hpp"
#include "target.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const char* ending : {".stl", ".ply", ".obj"}) {
    const fuzz::InputFile file(data, size, ending);
    fuzz::accept_refusal([&] { tumour::shape_from_mesh(tumour::read_mesh(file.path()), 1.0)({0.1, 0.2, 0.3}); });
  }
  return 0;
}
