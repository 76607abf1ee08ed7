// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Any bytes as a label image in the format of the VTK library: a body or a typed error.
#include "label_image.hpp"
#include "target.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::InputFile file(data, size, ".vti");
  fuzz::accept_refusal([&] { tumour::shape_from_image(tumour::read_vti(file.path()), 1, 1.0)({0.1, 0.2, 0.3}); });
  return 0;
}
