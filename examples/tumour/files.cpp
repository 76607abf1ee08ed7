// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include "files.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

#include <cambium/io/npy.hpp>

namespace tumour {
namespace {

template <class... A>
void add(std::string& text, const char* format, A... values) {
  char line[128];
  std::snprintf(line, sizeof line, format, values...);
  text += line;
}

std::string quoted(const std::string& name, const char* components = "1", const char* type = "Float64") {
  return "<DataArray type=\"" + std::string(type) + "\" Name=\"" + name + "\" NumberOfComponents=\"" + components +
         "\" format=\"ascii\">\n";
}
void add_data(std::string& text, const std::vector<Named>& data) {
  text += "<PointData>\n";
  for (const Named& item : data) {
    text += quoted(item.name);
    for (const double value : item.values) add(text, "%.9g\n", value);
    text += "</DataArray>\n";
  }
  text += "</PointData>\n";
}
std::string vtk_file(const char* type) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + std::string(type) +
         "\" version=\"1.0\" byte_order=\"LittleEndian\">\n";
}

/// The folder's entry of a file that was moved into it is on the disk, too.
void sync_folder(const std::filesystem::path& folder) {
  const int file = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  ::fsync(file);
  ::close(file);
}

}  // namespace

void write_whole(const std::filesystem::path& path, const std::string& text) {
  const std::string temporary = path.string() + ".part";
  const auto fail = [&](const char* what) {
    const int error = errno;
    ::unlink(temporary.c_str());
    throw cambium::FileError(cambium::detail::message("cannot ", what, " ", temporary, ": ", std::strerror(error), "; ",
                                                      path.string(), " is as it was before"));
  };
  const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) fail("create");
  bool good = true;
  for (std::size_t done = 0; good && done < text.size();) {
    const ssize_t count = ::write(file, text.data() + done, text.size() - done);
    good = count > 0 || (count < 0 && errno == EINTR);
    if (count > 0) done += static_cast<std::size_t>(count);
  }
  good = good && ::fsync(file) == 0;
  const int error = errno;
  const bool closed = ::close(file) == 0;
  if (!good) errno = error;
  if (!good || !closed) fail("write");
  if (std::rename(temporary.c_str(), path.c_str()) != 0) fail("move to its place");
  sync_folder(path.parent_path());
}

void write_curves(const std::filesystem::path& path, const cambium::Surface<2>& surface,
                  const std::vector<Named>& data) {
  std::string text = "component,x,y";
  for (const Named& item : data) text += ',' + item.name;
  text += '\n';
  const auto curves = cambium::closed_curves(surface);
  for (std::size_t k = 0; k < curves.size(); ++k) {
    for (const std::uint32_t v : curves[k]) {
      add(text, "%zu,%.12g,%.12g", k, surface.vertices[v][0], surface.vertices[v][1]);
      for (const Named& item : data) add(text, ",%.9g", item.values[v]);
      text += '\n';
    }
  }
  write_whole(path, text);
}

void write_surface(const std::filesystem::path& path, const cambium::Surface<3>& surface,
                   const std::vector<Named>& data) {
  std::string text = vtk_file("PolyData") + "<PolyData>\n";
  text += "<Piece NumberOfPoints=\"" + std::to_string(surface.vertices.size()) + "\" NumberOfPolys=\"" +
          std::to_string(surface.elements.size()) + "\">\n";
  add_data(text, data);
  text += "<Points>\n" + quoted("Points", "3");
  for (const auto& x : surface.vertices) add(text, "%.9g %.9g %.9g\n", x[0], x[1], x[2]);
  text += "</DataArray>\n</Points>\n<Polys>\n" + quoted("connectivity", "1", "Int64");
  for (const auto& e : surface.elements) add(text, "%u %u %u\n", e[0], e[1], e[2]);
  text += "</DataArray>\n" + quoted("offsets", "1", "Int64");
  for (std::size_t k = 1; k <= surface.elements.size(); ++k) add(text, "%zu\n", 3 * k);
  text += "</DataArray>\n</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
  write_whole(path, text);
}

template <int D>
void write_fields(const std::filesystem::path& path, const cambium::Lattice<D>& lattice,
                  const std::vector<Named>& data) {
  std::string extent, origin, spacing;
  for (int d = 0; d < 3; ++d) {
    add(extent, "0 %td ", d < D ? lattice.nodes()[d] - 1 : std::ptrdiff_t{0});
    add(origin, "%.17g ", d < D ? lattice.box().lo[d] : 0.0);
    add(spacing, "%.17g ", lattice.spacing());
  }
  std::string text = vtk_file("ImageData") + "<ImageData WholeExtent=\"" + extent + "\" Origin=\"" + origin +
                     "\" Spacing=\"" + spacing + "\">\n<Piece Extent=\"" + extent + "\">\n";
  add_data(text, data);
  write_whole(path, text + "</Piece>\n</ImageData>\n</VTKFile>\n");
}
template void write_fields<2>(const std::filesystem::path&, const cambium::Lattice<2>&, const std::vector<Named>&);
template void write_fields<3>(const std::filesystem::path&, const cambium::Lattice<3>&, const std::vector<Named>&);

}  // namespace tumour
