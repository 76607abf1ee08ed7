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

}  // namespace tumour
