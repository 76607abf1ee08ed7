// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Any bytes as a checkpoint, as they are and with the right checksum after them: what it holds or a typed error.
#include "checkpoint.hpp"

#include <zlib.h>

#include "target.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto sum = static_cast<std::uint32_t>(crc32_z(crc32(0, nullptr, 0), data, size));
  std::string sealed(reinterpret_cast<const char*>(data), size);
  sealed += "crc32:";
  sealed.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  for (const std::size_t length : {size, sealed.size()}) {
    const fuzz::InputFile file(reinterpret_cast<const std::uint8_t*>(sealed.data()), length, ".h5");
    fuzz::accept_refusal([&] { tumour::read_checkpoint(file.path()); });
  }
  return 0;
}
