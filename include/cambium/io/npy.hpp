// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <cambium/core/columns.hpp>
#include <cambium/core/error.hpp>
#include <cambium/core/field.hpp>

namespace cambium {

/// A file cannot be opened, written or read.
class FileError : public Error {
 public:
  using Error::Error;
};

namespace detail {

/// Header of a .npy file, version 1.0: magic string, length, and a Python dictionary padded to a multiple of 64 bytes.
template <class T>
std::string npy_header(std::span<const std::size_t> shape) {
  std::string dictionary = std::string("{'descr': '") + (std::endian::native == std::endian::little ? '<' : '>') +
                           (std::is_floating_point_v<T> ? 'f'
                            : std::is_signed_v<T>       ? 'i'
                                                        : 'u') +
                           std::to_string(sizeof(T)) + "', 'fortran_order': False, 'shape': (";
  for (const std::size_t extent : shape) dictionary += std::to_string(extent) + ", ";
  dictionary += "), }";
  constexpr std::size_t preamble = 10;
  const std::size_t total = (preamble + dictionary.size() + 1 + 63) / 64 * 64;
  dictionary.append(total - preamble - dictionary.size() - 1, ' ');
  const std::size_t length = total - preamble;
  std::string header("\x93NUMPY\x01\x00", 8);
  header += static_cast<char>(length % 256);
  header += static_cast<char>(length / 256);
  return header + dictionary + '\n';
}

inline std::ofstream open_for_writing(const std::filesystem::path& path) {
  std::ofstream out(path, std::ios::binary);
  if (!out) {
    throw FileError(message("cannot write ", path.string(), ": check that its folder exists and may be written to"));
  }
  return out;
}

inline void require_written(std::ofstream& out, const std::filesystem::path& path) {
  out.flush();
  if (!out) throw FileError(message("writing ", path.string(), " failed part of the way: is the disk full?"));
}

}  // namespace detail

/// Writes an array of numbers as a NumPy file (.npy), last axis fastest.
/// \throws SizeError unless the extents multiply to the number of values, FileError if the file cannot be written
template <class T>
void write_npy(const std::filesystem::path& path, std::span<const T> values, std::span<const std::size_t> shape) {
  static_assert(std::is_arithmetic_v<T>, "cambium::write_npy: the values of an array are numbers");
  std::size_t count = 1;
  for (const std::size_t extent : shape) count *= extent;
  require_size(values.size(), count, "the array to be written");
  std::ofstream out = detail::open_for_writing(path);
  const std::string header = detail::npy_header<T>(shape);
  out.write(header.data(), static_cast<std::streamsize>(header.size()));
  out.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size_bytes()));
  detail::require_written(out, path);
}

/// Writes a dense field; `numpy.load(path)[k, j, i]` is the value at node (i, j, k). Components of a vector field are
/// the last axis. \throws FileError if the file cannot be written
template <class V, int D>
void write_npy(const std::filesystem::path& path, const Field<V, D, Dense>& field) {
  using T = ScalarOf<V>;
  std::vector<std::size_t> shape;
  for (int d = D - 1; d >= 0; --d) shape.push_back(static_cast<std::size_t>(field.lattice().nodes()[d]));
  const T* first = nullptr;
  if constexpr (is_vec<V>) {
    static_assert(sizeof(V) == sizeof(T) * Components<V>::count);
    shape.push_back(Components<V>::count);
    first = field.data()->component;
  } else {
    first = field.data();
  }
  write_npy<T>(path, std::span<const T>(first, field.size() * Components<V>::count), shape);
}

/// Writes positions or a vector attribute of particles; `numpy.load(path)[c]` is component c of all of them.
/// \throws FileError if the file cannot be written
template <int C, class T>
void write_npy(const std::filesystem::path& path, const Columns<C, T>& columns) {
  using Scalar = std::remove_const_t<T>;
  std::vector<Scalar> values;
  values.reserve(columns.size() * C);
  for (int c = 0; c < C; ++c) values.insert(values.end(), columns.column(c).begin(), columns.column(c).end());
  const std::size_t shape[2] = {C, columns.size()};
  write_npy<Scalar>(path, std::span<const Scalar>(values), shape);
}

}  // namespace cambium
