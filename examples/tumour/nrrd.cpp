// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <utility>
#include <zlib.h>

#include <cambium/io/npy.hpp>

#include "files.hpp"
#include "label_image.hpp"

namespace tumour {
namespace {

using cambium::FileError;
using cambium::Vec;

constexpr std::ptrdiff_t most_voxels_along = 4096;

using Header = std::map<std::string, std::string>;

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw FileError(path.string() + ": " + why);
}

Header read_header(std::istream& in, const std::filesystem::path& path) {
  std::string line;
  std::getline(in, line);
  if (line.rfind("NRRD000", 0) != 0) refuse(path, "is not a NRRD file: it does not begin with NRRD000");
  Header header;
  while (std::getline(in, line)) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty()) return header;
    const std::size_t colon = line.find(": ");
    if (line[0] != '#' && colon != std::string::npos) header[line.substr(0, colon)] = line.substr(colon + 2);
  }
  refuse(path, "has no empty line after its header: is it cut off?");
}

const std::string& entry(const Header& header, const char* name, const std::filesystem::path& path) {
  const auto found = header.find(name);
  if (found == header.end()) refuse(path, std::string("has no line '") + name + ":'");
  return found->second;
}

/// `count` numbers from a line, whatever brackets and commas there are.
std::vector<double> numbers(std::string text, std::size_t count, const char* name, const std::filesystem::path& path) {
  for (char& c : text) c = c == '(' || c == ')' || c == ',' ? ' ' : c;
  std::istringstream in(text);
  std::vector<double> values;
  for (double value; in >> value;) values.push_back(value);
  bool good = values.size() == count && in.eof();
  for (const double value : values) good = good && std::isfinite(value);
  if (!good)
    refuse(path, std::string("line '") + name + ": " + text + "' should hold " + std::to_string(count) + " numbers");
  return values;
}

template <class V>
void take(const std::string& bytes, std::vector<int>& labels) {
  for (std::size_t i = 0; i < labels.size(); ++i) {
    V value;
    std::memcpy(&value, bytes.data() + i * sizeof(V), sizeof(V));
    labels[i] = static_cast<int>(value);
  }
}
struct Type {
  std::size_t bytes;
  void (*take)(const std::string&, std::vector<int>&);
};
Type type_of(const std::string& name, const std::filesystem::path& path) {
  if (name == "uint8" || name == "uchar" || name == "unsigned char") return {1, take<std::uint8_t>};
  if (name == "int8" || name == "signed char") return {1, take<std::int8_t>};
  if (name == "uint16" || name == "ushort" || name == "unsigned short") return {2, take<std::uint16_t>};
  if (name == "int16" || name == "short") return {2, take<std::int16_t>};
  if (name == "int32" || name == "int") return {4, take<std::int32_t>};
  refuse(path, "has values of type " + name + "; labels are integers of 8, 16 or (signed) 32 bits");
}

void find_place(const Header& header, LabelImage& image, const std::filesystem::path& path) {
  if (header.contains("space directions")) {
    const auto v = numbers(header.at("space directions"), 9, "space directions", path);
    for (std::size_t a = 0; a < 3; ++a) image.axis[a] = {v[3 * a], v[3 * a + 1], v[3 * a + 2]};
  } else {
    const auto v = numbers(entry(header, "spacings", path), 3, "spacings", path);
    for (int a = 0; a < 3; ++a)
      image.axis[static_cast<std::size_t>(a)] = Vec<3>::unit(a, v[static_cast<std::size_t>(a)]);
  }
  if (header.contains("space origin")) {
    const auto v = numbers(header.at("space origin"), 3, "space origin", path);
    image.origin = {v[0], v[1], v[2]};
  }
  require_place(image, path);
}

/// Inflates bytes of gzip piece by piece, up to one byte more than there should be.
std::string unpacked(std::string bytes, std::size_t expected, const std::filesystem::path& path) {
  constexpr int of_gzip = 16 + MAX_WBITS;
  constexpr std::size_t piece = 1 << 16;
  z_stream stream{};
  if (inflateInit2(&stream, of_gzip) != Z_OK) refuse(path, "cannot be unpacked: no memory");
  stream.next_in = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  std::string result;
  int state = Z_OK;
  while (state == Z_OK && result.size() <= expected) {
    const std::size_t before = result.size();
    result.resize(before + std::min(piece, expected + 1 - before));
    stream.next_out = reinterpret_cast<Bytef*>(result.data() + before);
    stream.avail_out = static_cast<uInt>(result.size() - before);
    state = inflate(&stream, Z_NO_FLUSH);
    result.resize(result.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (state != Z_STREAM_END && result.size() <= expected) refuse(path, "has bytes that are not all of a gzip stream");
  return result;
}

}  // namespace

LabelImage read_nrrd(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) refuse(path, "cannot be read: check that it is there");
  const Header header = read_header(in, path);
  numbers(entry(header, "dimension", path), 1, "dimension", path);
  if (entry(header, "dimension", path) != "3") refuse(path, "has dimension " + header.at("dimension") + ", not 3");
  const std::string encoding = entry(header, "encoding", path);
  const bool packed = encoding == "gzip" || encoding == "gz";
  if (!packed && encoding != "raw") refuse(path, "has encoding " + encoding + ": save it as raw or gzip");
  const Type type = type_of(entry(header, "type", path), path);
  if (type.bytes > 1 && entry(header, "endian", path) != "little") refuse(path, "is not of little endian");
  LabelImage image;
  const auto sizes = numbers(entry(header, "sizes", path), 3, "sizes", path);
  for (int d = 0; d < 3; ++d) {
    const double size = sizes[static_cast<std::size_t>(d)];
    if (!(size >= 2.0 && size <= most_voxels_along && size == std::floor(size))) {
      refuse(path, "line 'sizes: " + header.at("sizes") + "': whole numbers from 2 to 4096 are needed");
    }
    image.size[d] = static_cast<std::ptrdiff_t>(size);
  }
  find_place(header, image, path);
  // No more memory than the file is long is taken before its length is known to be right.
  const auto count = static_cast<std::size_t>(product(image.size));
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (packed) bytes = unpacked(std::move(bytes), count * type.bytes, path);
  if (bytes.size() != count * type.bytes) {
    refuse(path, "has " + std::to_string(bytes.size()) + " bytes of voxels where its header says " +
                     std::to_string(count * type.bytes));
  }
  image.labels.resize(count);
  type.take(bytes, image.labels);
  return image;
}

void write_nrrd(const std::filesystem::path& path, const LabelImage& image) {
  std::ostringstream out;
  out.precision(17);
  out << "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes:";
  for (int d = 0; d < 3; ++d) out << ' ' << image.size[d];
  const auto vector = [&](const Vec<3>& v) { out << " (" << v[0] << ',' << v[1] << ',' << v[2] << ')'; };
  out << "\nspace directions:";
  for (const Vec<3>& axis : image.axis) vector(axis);
  out << "\nspace origin:";
  vector(image.origin);
  out << "\nencoding: raw\n\n";
  for (const int label : image.labels) out << static_cast<char>(static_cast<unsigned char>(label));
  write_whole(path, out.str());
}

}  // namespace tumour
