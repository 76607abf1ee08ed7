// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include "checkpoint.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <hdf5.h>
#include <type_traits>
#include <zlib.h>

#include "files.hpp"

namespace tumour {
namespace {

constexpr const char* format = "cambium tumour checkpoint";
constexpr std::int64_t version = 1;
constexpr hsize_t chunk = 1 << 15;
constexpr hsize_t most_packed = 1100;  ///< bytes that a byte of deflate can stand for: 1032, rounded up
constexpr const char* damaged = "is cut off or damaged: take an older copy, or start the run once more";

/// Identifier of the library's that is closed at the end of a scope. \throws CheckpointError if there is none
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::filesystem::path& path, const std::string& what)
      : id_(id), close_(close) {
    if (id < 0) throw CheckpointError(path.string() + " " + damaged + " (" + what + ")");
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { close_(id_); }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Calls f(group, name, values) for all of a checkpoint, in an order that is always the same.
template <class F>
void for_each_array(const Checkpoint& checkpoint, F&& f) {
  f("texts", "configuration", checkpoint.configuration);
  f("texts", "series", checkpoint.series);
  f("texts", "report", checkpoint.report);
  for (const auto& [name, values] : checkpoint.state.reals) f("reals", name, values);
  for (const auto& [name, values] : checkpoint.state.whole) f("whole", name, values);
}

/// What follows the last byte of the library's: it does not read beyond what its own header says.
std::string trailer(const char* bytes, std::size_t count) {
  const auto sum =
      static_cast<std::uint32_t>(crc32_z(crc32(0, nullptr, 0), reinterpret_cast<const Bytef*>(bytes), count));
  std::string text(sizeof sum, '\0');
  std::memcpy(text.data(), &sum, sizeof sum);
  return "crc32:" + text;
}

template <class V>
hid_t type_of() {
  if constexpr (std::is_same_v<V, double>) return H5T_IEEE_F64LE;
  return std::is_same_v<V, char> ? H5T_STD_U8LE : H5T_STD_I64LE;
}
template <class V>
hid_t native_type_of() {
  if constexpr (std::is_same_v<V, double>) return H5T_NATIVE_DOUBLE;
  return std::is_same_v<V, char> ? H5T_NATIVE_UCHAR : H5T_NATIVE_INT64;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw CheckpointError(path.string() + ": there is no checkpoint that can be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A file by the HDF5 library.
class File {
 public:
  explicit File(const std::filesystem::path& path)
      : path_(path), access_(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, path, "access") {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are said by what is thrown
  }

  /// Bytes of the file; nothing goes to the disk.
  std::string write(const Checkpoint& checkpoint) {
    H5Pset_fapl_core(access_, 1 << 20, false);
    const Handle file(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access_), H5Fclose, path_, "creating");
    write_attribute(file, "format", std::string(format));
    write_attribute(file, "version", std::vector{version});
    for (const char* group : {"texts", "reals", "whole"}) {
      Handle(H5Gcreate2(file, group, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, path_, group);
    }
    for_each_array(checkpoint, [&](const std::string& group, const std::string& name, const auto& values) {
      write_data(file, group + "/" + name, values);
    });
    require(H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0, "flushing");
    std::string bytes(static_cast<std::size_t>(std::max<ssize_t>(0, H5Fget_file_image(file, nullptr, 0))), '\0');
    require(H5Fget_file_image(file, bytes.data(), bytes.size()) > 0, "taking its image");
    return bytes;
  }

  Checkpoint read() {
    bytes_ = std::filesystem::file_size(path_);
    const Handle file(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, access_), H5Fclose, path_, "opening");
    std::string said;
    std::vector<std::int64_t> number;
    read_attribute(file, "format", said);
    if (said != format) throw CheckpointError(path_.string() + " is not a checkpoint of this program: " + said);
    read_attribute(file, "version", number);
    require(number.size() == 1, "version");
    if (number[0] != version) {
      throw CheckpointError(cambium::detail::message(path_.string(), " is of version ", number[0],
                                                     ", this program reads version ", version,
                                                     ": go on with the program that wrote it"));
    }
    Checkpoint checkpoint;
    read_data(file, "texts/configuration", checkpoint.configuration);
    read_data(file, "texts/series", checkpoint.series);
    read_data(file, "texts/report", checkpoint.report);
    read_group(file, "reals", checkpoint.state.reals);
    read_group(file, "whole", checkpoint.state.whole);
    return checkpoint;
  }

 private:
  void require(bool good, const std::string& what) const {
    if (!good) throw CheckpointError(path_.string() + " " + damaged + " (" + what + ")");
  }
  template <class Values>
  void write_attribute(hid_t file, const char* name, const Values& values) {
    using V = typename Values::value_type;
    const hsize_t size = values.size();
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, path_, name);
    const Handle at(H5Acreate2(file, name, type_of<V>(), space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, path_, name);
    require(H5Awrite(at, native_type_of<V>(), values.data()) >= 0, name);
  }
  template <class Values>
  void read_attribute(hid_t file, const char* name, Values& values) {
    const Handle at(H5Aopen(file, name, H5P_DEFAULT), H5Aclose, path_, name);
    const Handle space(H5Aget_space(at), H5Sclose, path_, name);
    values.resize(extent_of(space, H5Aget_storage_size(at), name));
    require(H5Aread(at, native_type_of<typename Values::value_type>(), values.data()) >= 0, name);
  }
  /// In compressed pieces, each with a checksum.
  template <class Values>
  void write_data(hid_t file, const std::string& name, const Values& values) {
    using V = typename Values::value_type;
    const hsize_t size = values.size(), piece = std::min(size, chunk);
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, path_, name);
    const Handle how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, path_, name);
    if (size > 0) {
      H5Pset_chunk(how, 1, &piece);
      H5Pset_shuffle(how);
      H5Pset_deflate(how, 1);
      H5Pset_fletcher32(how);
    }
    const Handle data(H5Dcreate2(file, name.c_str(), type_of<V>(), space, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose,
                      path_, name);
    require(H5Dwrite(data, native_type_of<V>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0, name);
  }
  template <class Values>
  void read_data(hid_t file, const std::string& name, Values& values) {
    const Handle data(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, path_, name);
    const Handle space(H5Dget_space(data), H5Sclose, path_, name);
    values.resize(extent_of(space, most_packed * H5Dget_storage_size(data), name));
    using V = typename Values::value_type;
    require(H5Dread(data, native_type_of<V>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0, name);
  }
  template <class Map>
  void read_group(hid_t file, const char* name, Map& map) {
    const Handle group(H5Gopen2(file, name, H5P_DEFAULT), H5Gclose, path_, name);
    H5G_info_t info{};
    require(H5Gget_info(group, &info) >= 0, name);
    for (hsize_t k = 0; k < info.nlinks; ++k) {
      char entry[256] = {};
      require(H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, entry, sizeof entry, H5P_DEFAULT) > 0,
              name);
      read_data(group, entry, map[entry]);
    }
  }
  /// A size that is damaged is not to take all memory: values have a byte each at least, and the file has them.
  std::size_t extent_of(hid_t space, hsize_t most, const std::string& name) const {
    const hssize_t size = H5Sget_simple_extent_npoints(space);
    require(size >= 0 && static_cast<hsize_t>(size) <= std::min(most, most_packed * bytes_), name);
    return static_cast<std::size_t>(size);
  }

  std::filesystem::path path_;
  Handle access_;
  hsize_t bytes_ = 0;  ///< of the file that is read
};

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint) {
  // What goes to the disk goes there by write_whole(), whose errors are plain.
  std::string bytes = File(path).write(checkpoint);
  bytes += trailer(bytes.data(), bytes.size());
  write_whole(path, bytes);
}

Checkpoint read_checkpoint(const std::filesystem::path& path) {
  const std::string bytes = bytes_of(path);
  const std::size_t length = trailer("", 0).size();
  if (bytes.size() < length || bytes.substr(bytes.size() - length) != trailer(bytes.data(), bytes.size() - length)) {
    throw CheckpointError(path.string() + " " + damaged + " (its checksum is another)");
  }
  return File(path).read();
}

}  // namespace tumour
