// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include "options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include <cambium/core/error.hpp>

#include "numbers.hpp"
#include "scenes.hpp"
#include "shape.hpp"

namespace tumour {
namespace {

std::string joined(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ",") + CLI::detail::to_string(value);
  return text;
}

void add_options(CLI::App& app, Options& o) {
  app.option_defaults()->always_capture_default();
  app.add_option("--scene", o.scene, "one of those that --list names; what is said beside it goes before");
  app.add_option("--dim", o.dim, "plane or space")->check(CLI::IsMember({2, 3}));
  app.add_option("--n", o.cells, "cells along a side of the box")->check(CLI::Range(16, 1024));
  app.add_option("--box", o.box, "length of a side of the box, its middle at 0")->check(CLI::PositiveNumber);
  app.add_option("--shape", o.shape, shape_help());
  app.add_option("--A", o.parameters.apoptosis, "rate of death relative to growth");
  app.add_option("--G", o.parameters.growth, "growth");
  app.add_option("--GN", o.parameters.necrotic_decay, "loss of volume in the necrotic core");
  app.add_option("--N", o.parameters.necrotic_limit, "cells die where the nutrient is below it; 0: none do");
  app.add_option("--gamma", o.parameters.tension, "surface tension, times the sum of the principal curvatures");
  app.add_option("--outside", o.outside, "pressure outside")->check(CLI::IsMember({"free-space", "zero", "periodic"}));
  app.add_option("--cfl", o.courant, "spacings that the interface travels in a step")->check(CLI::PositiveNumber);
  app.add_option_function<std::string>(
         "--at", [&o](const std::string& text) { o.at = numbers("--at", text); },
         "times of pictures and files, rising, with commas between; the last ends the run")
      ->default_str(joined(o.at));
  app.add_option("--out", o.out, "folder of the run");
  app.add_option("--json", o.json, "file for the report; report.json in the folder is written in any case");
  app.add_option("--threads", o.threads, "0: as many as OpenMP takes")->check(CLI::NonNegativeNumber);
  app.add_flag("--page,!--no-page", o.page, "draw pictures and the page at the end (needs python3-matplotlib)")
      ->configurable(false);
  app.add_flag("--dry-run", o.dry_run, "check the options and print them")->configurable(false);
  app.add_flag("--list", o.list, "print the scenes")->configurable(false);
  app.add_option("--checkpoint", o.checkpoint, "seconds between checkpoints; there is one at the end in any case")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--resume", o.resume, "go on from a run's folder, or its checkpoint.h5, with the options of that run")
      ->configurable(false);
  app.add_option(
         "--make-image", o.make_image,
         "write a label image (.nrrd, .vti) or a mesh (.stl, .ply, .obj) of the shape, which is in space, and end")
      ->configurable(false);
  app.add_flag("--smoke", o.smoke, "a small lattice and two steps, to see that everything works")->configurable(false);
}

/// What the command line or its configuration file names of an option, alone.
std::string value_of(const char* option, const char* otherwise, int argc, const char* const* argv) {
  std::string value = otherwise;
  CLI::App app;
  app.allow_extras();
  app.allow_config_extras(true);
  app.set_help_flag();
  app.set_config("--config");
  app.add_option(option, value);
  app.parse(argc, argv);
  return value;
}

/// The options of a configuration.
class SavedOptions {
 public:
  explicit SavedOptions(const std::string& configuration) {
    add_options(app_, options_);
    std::istringstream in(configuration);
    app_.parse_from_stream(in);
  }
  const Options& options() const { return options_; }
  /// Makes their texts, of which numbers may have lost digits, those that are written where nothing else is said.
  void give_defaults(CLI::App& app) const {
    for (const CLI::Option* option : app_.get_options()) {
      if (option->count() == 0 || !option->get_configurable()) continue;
      std::string text;
      for (const std::string& part : option->results()) text += (text.empty() ? "" : ",") + part;
      app.get_option(option->get_name())->default_str(text);
    }
  }

 private:
  CLI::App app_;
  Options options_;
};

/// Only where a run leaves things, how fast it goes, and how long, may change under way.
void require_same_run(const Options& saved, Options now) {
  now.at = saved.at;
  now.out = saved.out;
  now.json = saved.json;
  now.threads = saved.threads;
  now.checkpoint = saved.checkpoint;
  now.page = saved.page;
  now.dry_run = saved.dry_run;
  now.resume = saved.resume;
  if (now == saved) return;
  throw cambium::ValueError(
      "--resume: other options than those of the run that is gone on with: only --at, --out, --json, --threads, "
      "--checkpoint and --no-page can be given; start another run for the rest");
}

void require_sense(const Options& o, bool shape) {
  using cambium::ValueError;
  using cambium::detail::message;
  cambium::require_parameters(o.parameters);
  bool rising = !o.at.empty();
  for (std::size_t k = 0; k < o.at.size(); ++k) {
    rising = rising && std::isfinite(o.at[k]) && o.at[k] > (k > 0 ? o.at[k - 1] : 0.0);
  }
  if (!rising) throw ValueError("--at: times must be positive, finite and rising, as in --at 0.5,1");
  if (shape) require_shape(o.shape, o.dim);
}

}  // namespace

Options read_options(int argc, const char* const* argv, std::string& configuration, std::optional<Checkpoint>& saved) {
  const std::string resume = value_of("--resume", "", argc, argv);
  const std::string scene = value_of("--scene", "none", argc, argv);
  Options options = scene == "none" || !resume.empty() ? Options{} : scene_options(scene);
  CLI::App app{
      "Grows a tumour and leaves surfaces, fields, a time series, pictures and a page in a folder.\n"
      "It ends well when the tumour reaches the box, when it dies out and when it is told to stop (Ctrl-C)."};
  app.set_config("--config", "", "file of options, as the run wrote it into its folder");
  std::optional<SavedOptions> before;
  if (!resume.empty()) {
    const bool folder = std::filesystem::is_directory(resume);
    saved = read_checkpoint(resume + (folder ? "/checkpoint.h5" : ""));
    before.emplace(saved->configuration);
    options = before->options();
    if (folder) options.out = resume;
  }
  add_options(app, options);
  if (before) before->give_defaults(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    app.exit(help);
    throw;
  }
  if (options.smoke) {
    options.cells = 32;
    options.dim = 2;
  }
  if (before) require_same_run(before->options(), options);
  if (!options.list) require_sense(options, !saved);
  configuration = app.config_to_str(true, false);
  return options;
}

}  // namespace tumour
