// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include <cambium/core/snapshot.hpp>
#include <cambium/io/npy.hpp>

namespace tumour {

/// A checkpoint cannot be read: it is not one, is cut off or damaged, or of another version or run.
class CheckpointError : public cambium::FileError {
 public:
  using FileError::FileError;
};

/// Everything that a run goes on from.
struct Checkpoint {
  std::string configuration;  ///< as a file that --config reads
  std::string series;         ///< what series.csv holds
  std::string report;         ///< what report.json holds
  cambium::Snapshot state;    ///< of the tumour and, with names "run.", of the program
};

/// Writes a checkpoint as HDF5: groups `texts`, `reals` and `whole` of named data sets, each with Fletcher's checksum,
/// and the attributes `format` and `version`. After the library's last byte come `crc32:` and the four bytes of that
/// sum of all before. The file is replaced as a whole or stays as it is. \throws cambium::FileError
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);
/// \throws CheckpointError that says what is wrong with the file; cambium::FileError if it cannot be read
Checkpoint read_checkpoint(const std::filesystem::path& path);

}  // namespace tumour
