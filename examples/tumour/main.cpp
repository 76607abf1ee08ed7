// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Grows a tumour: any case from the command line, or a scene by its name (--list). docs/tumour.md shows them.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

#include <cambium/core/error.hpp>
#include <cambium/models/tumour/free_space.hpp>
#include <cambium/models/tumour/periodic.hpp>
#include <cambium/models/tumour/zero_outside.hpp>

#include "files.hpp"
#include "label_image.hpp"
#include "mesh_file.hpp"
#include "options.hpp"
#include "page.hpp"
#include "run.hpp"
#include "scenes.hpp"

using namespace tumour;

namespace {

template <int D>
nlohmann::json run_in(const Options& options, const std::string& configuration, const StopRequests& stop,
                      const Checkpoint* saved) {
  if (options.outside == "zero") return run<D, cambium::ZeroOutside>(options, configuration, stop, saved);
  if (options.outside == "periodic") return run<D, cambium::Periodic>(options, configuration, stop, saved);
  return run<D, cambium::FreeSpace>(options, configuration, stop, saved);
}

int grow(const Options& options, const std::string& configuration, const Checkpoint* saved) {
  const StopRequests stop;
  const auto report = options.dim == 2 ? run_in<2>(options, configuration, stop, saved)
                                       : run_in<3>(options, configuration, stop, saved);
  if (!options.json.empty()) write_whole(options.json, report.dump(2) + "\n");
  std::printf("the run is in %s\n", options.out.c_str());
  if (options.page && !draw_page(options.out)) {
    std::printf("its pictures could not be drawn; later: %s\n", page_command(options.out).c_str());
  }
  return 0;
}

int list() {
  for (const Scene& scene : scenes()) std::printf("%-20s %s\n", scene.name.c_str(), scene.what.c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    std::string configuration;
    std::optional<Checkpoint> saved;
    const Options options = read_options(argc, argv, configuration, saved);
    if (options.list) return list();
    if (options.dry_run) return std::fputs(configuration.c_str(), stdout) < 0 ? 1 : 0;
    if (!options.make_image.empty()) {
      const auto shape = shape_of<3>(options.shape);
      if (is_mesh(options.make_image)) {
        write_mesh(options.make_image, mesh_of(shape, options.box, options.cells));
      } else {
        write_image(options.make_image, image_of(shape, 0.5 * options.box));
      }
      return 0;
    }
    return grow(options, configuration, saved ? &*saved : nullptr);
  } catch (const CLI::Success&) {
    return 0;
  } catch (const CLI::Error& error) {
    std::fprintf(stderr, "%s\n(see --help)\n", error.what());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
  return 1;
}
