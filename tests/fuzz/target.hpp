// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

#include <cambium/core/error.hpp>

namespace fuzz {

/// The bytes of an input as a file, which goes at the end of a scope: the readers take paths.
class InputFile {
 public:
  InputFile(const std::uint8_t* data, std::size_t size, const std::string& ending)
      : path_(std::filesystem::temp_directory_path() / ("cambium-fuzz-" + std::to_string(::getpid()) + ending)) {
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile() { std::remove(path_.c_str()); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Calls f, which may refuse its input by an error of the library's own; any other leaves, and ends the program.
template <class F>
void accept_refusal(F&& f) {
  try {
    f();
  } catch (const cambium::Error&) {
    // the input was refused
  }
}

}  // namespace fuzz

/// What libFuzzer, or replay.cpp, calls with every input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
