// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Any bytes as a file of options: options that make sense or a typed error.
#include <CLI/CLI.hpp>

#include "options.hpp"
#include "target.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::InputFile file(data, size, ".ini");
  const char* const arguments[] = {"tumour", "--config", file.path().c_str()};
  fuzz::accept_refusal([&] {
    try {
      std::string configuration;
      std::optional<tumour::Checkpoint> saved;
      tumour::read_options(3, arguments, configuration, saved);
    } catch (const CLI::ParseError&) {
      // the options were refused
    }
  });
  return 0;
}
