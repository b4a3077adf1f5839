// Options into structs, each command with an example of its own.
#include "command_line.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "exact_problems.h"
#include "option_checks.h"
#include "vpm/base/version.h"
#include "vpm/study/validate/ladder.h"

namespace vpm::tools {
namespace {

void add_progress(CLI::App* command, ProgressMode& mode) {
  const std::map<std::string, ProgressMode> modes{
      {"auto", ProgressMode::automatic}, {"always", ProgressMode::always}, {"never", ProgressMode::never}};
  command->add_option("--progress", mode, "Progress bar: auto (on a terminal), always, never")
      ->transform(CLI::CheckedTransformer(modes));
}

void add_exposure(CLI::App* command, std::optional<float>& exposure, const std::string& what) {
  command
      ->add_option("--exposure", exposure,
                   fmt::format("Stops by which {} is exposed: values times 2^STOPS, clipped to [0, 1], then the sRGB "
                               "curve; default: such that the 99th percentile of the luminance becomes 0.8",
                               what))
      ->check(check_stops);
}

/// Options of all commands that trace photons or paths; `output`: what is written where.
void add_scene_options(CLI::App* command, SceneOptions& options, const std::string& output) {
  command->add_option("-o,--output", options.output, output + " in the current folder");
  command->add_option("--set", options.overrides, "Change a key of the scene: key.path=value; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--threads", options.threads, "Threads; 0: one for each core")->check(whole_number(0, 1024));
  command->add_option("--seed", options.seed, "Seed of all random numbers")->check(check_seed);
  add_progress(command, options.progress);
}

/// Options of all commands that run passes; returns the option --passes.
CLI::Option* add_pass_options(CLI::App* command, PassOptions& options, const std::string& usual_name) {
  add_scene_options(command, options, "Image to write (.exr); default: " + usual_name + ".exr");
  add_exposure(command, options.exposure, "the preview");
  return command->add_option("--passes", options.passes, "Passes to average")->check(whole_number(1, 1'000'000'000));
}

void add_watch_options(CLI::App* command, WatchOptions& options) {
  command->add_option_function<std::string>(
      "--display", [&options](const std::string& text) { options.display = tev_address(text); },
      "Show the picture after each pass in the viewer tev: tev, or tev:HOST:PORT where it does not listen as usual");
  command
      ->add_option("--preview", options.preview,
                   "Write picture, preview and report after the first pass already, and again after the passes that "
                   "end this many seconds or more after the last time, and ten times as long as that took")
      ->check(check_seconds);
}

void add_scene(CLI::App* command, std::string& scene) {
  command->add_option("scene", scene, "Scene file (.toml)")->required();
}

/// Options of all that render a picture.
void add_picture_options(CLI::App* command, RenderOptions& options, const std::string& usual_name) {
  CLI::Option* passes = add_pass_options(command, options, usual_name);
  command
      ->add_option("--time", options.seconds,
                   "End within this many seconds from the start of the process; the first pass may take twice as long")
      ->check(check_seconds)
      ->excludes(passes);
  command
      ->add_option("--error", options.error,
                   "Render passes until the estimated relative MSE is no more than this; with --time: or until then")
      ->check(check_error)
      ->excludes(passes);
  command->add_option("--size", options.size, "Film in pixels, WIDTHxHEIGHT: 640x480")->check(check_film_size);
  command->add_option("--spp", options.samples, "Samples of a pixel in each pass")->check(whole_number(1, 1'000'000));
  command
      ->add_option("--crop", options.crop,
                   "Render these pixels only, x0,y0,x1,y1 from the upper left, ends excluded: the same bits as in the "
                   "whole picture")
      ->check(check_crop);
  add_watch_options(command, options.watch);
  command->add_flag("--quiet", options.quiet, "Print nothing but warnings and errors");
}

void add_render(CLI::App& app, RenderOptions& options) {
  CLI::App* command = app.add_subcommand("render", "Render a scene to an EXR image, a PNG preview and a JSON report");
  command->footer(
      "Example: vpm render scenes/smoke.toml --time 20 renders for 20 seconds to smoke.exr, smoke.png and smoke.json.");
  add_scene(command, options.scene);
  add_picture_options(command, options, "SCENE");
  command->add_option("--reference", options.reference,
                      "EXR image of the truth: log error against time to a CSV file next to the image");
  command->add_flag(
      "--auto", options.automatic,
      "Choose radii and photons where the scene leaves them out, and with a time all of [integrator] where neither the "
      "scene nor an option names its type; say why");
  command
      ->add_option("--layers", options.layers,
                   "Write these layers, too, separated by commas: combined (what each technique finds), and of what a "
                   "pixel sees depth, normal, albedo, transmittance, single-scattering-albedo, emission, samples")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember(known_layers()));
  command
      ->add_option("--pass-range", options.pass_range,
                   "Render a piece, of all passes those of these numbers: 0:64 ends with pass 63. vpm merge makes one "
                   "picture of the pieces' checkpoints. --passes is then how many there are in all, for what is "
                   "\"auto\"")
      ->check(check_pass_range)
      ->excludes("--time")
      ->excludes("--error");
  CLI::Option* checkpoint =
      command->add_flag("--checkpoint", options.checkpoint, "Write a checkpoint next to the image after each pass");
  CLI::Option* overwrite =
      command->add_flag("--overwrite", options.overwrite, "Let that checkpoint replace one that is there already");
  overwrite->needs(checkpoint);
  command->add_flag("--resume", options.resume, "Go on from that checkpoint, and keep it up to date")
      ->excludes(overwrite);
}

void add_view(CLI::App& app, ViewOptions& options) {
  CLI::App* command = app.add_subcommand("view", "Show a grid (.vdb): makes a scene around it and renders that");
  command->footer(
      "Example: vpm view plume.vdb --up z --optical-depth 4 shows a plume whose up is z to plume.exr and plume.png.");
  command->add_option("grid_file", options.scene, "Grid file (.vdb)")->required();
  add_picture_options(command, options, "FILE");
  command->add_option("--grid", options.wishes.grid, "Name of the grid; default: \"density\", or the only one");
  command
      ->add_option("--optical-depth", options.wishes.optical_depth,
                   "Optical depth across the medium, from which the extinction follows")
      ->check(check_depth)
      ->capture_default_str();
  const std::map<std::string, UpAxis> axes{{"y", UpAxis::y}, {"z", UpAxis::z}};
  command->add_option("--up", options.wishes.up, "Axis that is up: y (default), or z")
      ->transform(CLI::CheckedTransformer(axes));
  CLI::Option* scene =
      command->add_option("--scene", options.scene_output, "Also write the scene that is made, for editing (.toml)");
  CLI::Option* slice =
      command->add_option("--slice", options.slice,
                          "Draw a slice across an axis, x, y or z, with a scale of its values, instead: y=0.25 (m), or "
                          "y for the middle. Default output: FILE.svg");
  slice->check(check_slice)->excludes(scene);
  for (const char* other : {"--passes", "--time", "--error", "--size", "--spp", "--crop", "--optical-depth", "--up",
                            "--set", "--seed", "--exposure", "--display", "--preview", "--quiet"})
    slice->excludes(command->get_option(other));
}

void add_merge(CLI::App& app, MergeOptions& options) {
  CLI::App* command =
      app.add_subcommand("merge", "Merge pieces of a render (--pass-range) into the picture of one run");
  command->footer("Example: vpm merge a.checkpoint b.checkpoint -o whole.exr joins the two pieces of a render.");
  command->add_option("pieces", options.pieces, "Checkpoints of the pieces, in any order")->required();
  command->add_option("-o,--output", options.output,
                      "Image to write (.exr); default: merged.exr in the current folder");
  command->add_option("--scene", options.scene,
                      "Scene file, where it is no longer where the first piece was rendered from");
  add_exposure(command, options.exposure, "the preview");
  CLI::Option* checkpoint =
      command->add_flag("--checkpoint", options.checkpoint, "Also write a checkpoint of the whole next to the image");
  command->add_flag("--overwrite", options.overwrite, "Let that checkpoint replace one that is there already")
      ->needs(checkpoint);
  command->add_option("--threads", options.threads, "Threads; 0: one for each core")->check(whole_number(0, 1024));
}

void add_tonemap(CLI::App& app, TonemapOptions& options) {
  CLI::App* command = app.add_subcommand("tonemap", "Write an EXR picture as a PNG file");
  command->footer("Example: vpm tonemap smoke.exr smoke.png --exposure 1 shows the picture twice as bright as it is.");
  command->add_option("picture", options.picture, "Picture (.exr)")->required();
  command->add_option("output", options.output, "File to write (.png)")->required();
  command->add_option("--layer", options.layer, "Name of the layer to take, or of a channel, as grey");
  add_exposure(command, options.exposure, "the picture");
}

void add_upgrade(CLI::App& app, UpgradeOptions& options) {
  CLI::App* command =
      app.add_subcommand("upgrade", "Rewrite scenes and experiments that have the keys of older versions");
  command->footer(
      "Example: vpm upgrade fog.toml rewrites the file with its comments, and keeps the old one as "
      "fog.toml.old.");
  command->add_option("files", options.files, "Scenes or experiments (.toml)");
  command->add_option("-o,--output", options.output, "File to write in the place of the one that is read");
  command->add_flag("--keys", options.keys, "Print each old key and what it is now");
}

void add_bake(CLI::App& app, BakeOptions& options) {
  CLI::App* command =
      app.add_subcommand("bake", "Bake the irradiance on a shape over its texture coordinates into an EXR light map");
  command->footer(
      "Example: vpm bake room.toml --mesh floor --resolution 256 bakes what arrives at the shape named floor to "
      "room.floor.exr.");
  add_scene(command, options.scene);
  add_pass_options(command, options, "SCENE.MESH");
  command->add_option("--mesh", options.mesh, "Name of the shape: a quad, or a mesh with texture coordinates")
      ->required();
  command->add_option("--resolution", options.resolution, "Texels along an edge of the map")
      ->check(whole_number(1, 16384))
      ->capture_default_str();
}

void add_photons(CLI::App& app, PhotonsOptions& options) {
  CLI::App* command = app.add_subcommand("photons", "Write the photons that a render stores, or their paths, as data");
  command->footer(
      "Example: vpm photons scenes/smoke.toml -o smoke.ply writes the photon maps of the first pass for a viewer of "
      "points.");
  add_scene(command, options.scene);
  add_scene_options(command, options, "File to write (.ply or .csv); default: SCENE.ply");
  command->add_flag("--paths", options.paths, "Write the flights of all photons, as lines, instead");
  command->add_option("--pass", options.pass, "Of this pass, numbered from 0")
      ->check(whole_number(0, 1'000'000'000))
      ->capture_default_str();
}

void add_count_options(CLI::App* command, CountOptions& options) {
  CLI::Option* passes =
      command->add_option("--passes", options.passes, "Passes to average, of as many photons as the scene says")
          ->check(whole_number(1, 1'000'000'000))
          ->capture_default_str();
  command
      ->add_option("--time", options.seconds,
                   "Passes until so many seconds from the start of the process are over, as far as they fit")
      ->check(check_seconds)
      ->excludes(passes);
}

void add_fluence(CLI::App& app, FluenceOptions& options) {
  CLI::App* command =
      app.add_subcommand("fluence", "Measure fluence and absorbed power inside media, in the cells of a box");
  command->footer(
      "Example: vpm fluence scenes/fog_room.toml -o room.vdb --resolution 32 writes grids: fluence in W/m^2, absorbed "
      "power in W/m^3, and their standard errors.");
  add_scene(command, options.scene);
  add_scene_options(command, options, "File to write (.npy or .vdb); default: SCENE.fluence.npy");
  command->add_option("--box", options.box, "Corners x0 y0 z0 x1 y1 z1, m; default: the box around all shapes")
      ->expected(6);
  command->add_option("--resolution", options.resolution, "Cells along the longest edge of the box")
      ->check(whole_number(1, 4096))
      ->capture_default_str();
  command->add_flag("--flux", options.flux, "Net flux, too, W/m^2 along x, y and z");
  add_count_options(command, options);
}

void add_measure(CLI::App& app, MeasureOptions& options) {
  CLI::App* command =
      app.add_subcommand("measure", "Count the power that passes detectors, with standard errors, and what is exact");
  command->footer(
      "Example: vpm measure scenes/slab.toml --time 10 prints what a slab reflects, transmits and absorbs, beside the "
      "exact values.");
  add_scene(command, options.scene);
  add_scene_options(command, options, "File to write besides (.json, or .html as a page)");
  command->add_flag("--json", options.json, "Print JSON");
  add_count_options(command, options);
}

void add_compare(CLI::App& app, CompareOptions& options) {
  CLI::App* command =
      app.add_subcommand("compare", "Compare methods, error against cost, on scenes of an experiment file");
  command->footer(
      "Example: vpm compare scenes/experiments/fog-exact.toml -o fog writes tables and a page of all methods to the "
      "folder fog.");
  command->add_option("experiment", options.experiment, "Experiment file (.toml)")->required();
  command->add_option("-o,--output", options.output, "Folder for results; an interrupted comparison goes on in it")
      ->required();
  command->add_option("--set", options.overrides, "Change a key of the experiment: key.path=value; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--threads", options.threads, "Threads; 0: one for each core")->check(whole_number(0, 1024));
  add_progress(command, options.progress);
}

void add_info(CLI::App& app, InfoOptions& options) {
  CLI::App* command = app.add_subcommand("info", "List what a scene or a .vdb file holds, and what a render would run");
  command->footer(
      "Example: vpm info smoke.vdb lists the grids of a file; vpm info scenes/smoke.toml what a render would do.");
  command->add_option("file", options.file, "Scene (.toml) or grid file (.vdb)")->required();
  command->add_option("--set", options.overrides, "Change a key of the scene: key.path=value; may be repeated")
      ->allow_extra_args(false);
  command->add_flag("--all", options.all, "Also list which stages are skipped and why, and details of grids");
}

void add_error(CLI::App& app, ErrorOptions& options) {
  CLI::App* command = app.add_subcommand("error", "Measure how far a picture is from a reference, or several from one");
  command->footer(
      "Example: vpm error smoke.exr reference.exr --worst 5 prints how far apart they are, and where most.");
  command->add_option("images", options.images, "Picture and reference (.exr); with --series the reference is the last")
      ->required();
  CLI::Option* series = command->add_flag("--series", options.series,
                                          "A line for each picture, and how their errors fall with their passes");
  command->add_option("--layer", options.layer, "Name of the picture's layer to compare, or of a channel, as grey");
  command->add_option("--reference-layer", options.reference_layer, "The same of the reference");
  command->add_option("-o,--output", options.output, "File for the difference, picture less reference (.exr)")
      ->excludes(series);
  command->add_flag("--resample", options.resample, "Bring the picture to the size of the reference")->excludes(series);
  command->add_option("--worst", options.worst, "Pixels to list, those with the largest part in the relative MSE")
      ->check(whole_number(0, 1'000'000))
      ->capture_default_str()
      ->excludes(series);
  command->add_flag("--json", options.json, "Print JSON");
}

void add_report(CLI::App& app, ReportOptions& options) {
  CLI::App* command =
      app.add_subcommand("report", "Make one page of a render: picture, errors, times, energy, settings");
  command->footer("Example: vpm report smoke.json makes the page smoke.html of a render.");
  command->add_option("report", options.report, "JSON report that vpm render wrote beside its image")->required();
  command->add_option("-o,--output", options.output, "Page to write (.html); default: the report's name");
}

void add_media(CLI::App& app, MediaOptions& options) {
  CLI::App* command = app.add_subcommand("media", "Make one of vpm's own density grids; without a name: list them");
  command->footer("Example: vpm media smoke --resolution 96 -o smoke.vdb writes the smoke of the examples.");
  command->add_option("name", options.name, "Which one");
  command->add_option("--resolution", options.resolution, "Voxels along the longest edge")->capture_default_str();
  command->add_option("-o,--output", options.output, "File to write (.vdb); default: NAME.vdb in the current folder");
}

void add_mesh(CLI::App& app, MeshOptions& options) {
  CLI::App* command = app.add_subcommand("mesh", "Make one of vpm's own triangle meshes; without a name: list them");
  command->footer("Example: vpm mesh waves --resolution 64 -o waves.ply writes the water of the examples.");
  command->add_option("name", options.name, "Which one");
  command->add_option("--resolution", options.resolution, "Edges along its side or around its axis")
      ->capture_default_str();
  command->add_option("-o,--output", options.output, "File to write (.ply); default: NAME.ply in the current folder");
}

void add_validate(CLI::App& app, ValidateOptions& options) {
  CLI::App* command = app.add_subcommand("validate", "Check vpm's numbers against identities and transport theory");
  command->footer("Example: vpm validate --level 1 checks the identities alone.");
  CLI::Option* level = command
                           ->add_option("--level", options.level,
                                        "Only this level: 0 distributions, 1 identities, 2 transport theory, "
                                        "3 agreement, 4 convergence")
                           ->check(whole_number(0, kLevels - 1));
  CLI::Option* only = command->add_option("--only", options.only, "Only experiments whose name holds this text");
  command
      ->add_option("--oracles", options.oracles,
                   "Instead: check every case of the reference numbers in the files of this folder")
      ->excludes(level)
      ->excludes(only);
  CLI::Option* quick = command->add_flag_callback(
      "--quick", [&options] { options.full = false; }, "Two and a half minutes on two cores (the default)");
  command->add_flag("--full", options.full, "Tight errors, some 20 minutes")->excludes(quick);
  command->add_option("--seed", options.seed, "Seed of all random numbers")->check(check_seed);
  command->add_option("--rate", options.rate, "Probability that right code fails the run")
      ->check(check_rate)
      ->capture_default_str();
  command->add_option("--threads", options.threads, "Threads; 0: one for each core")->check(whole_number(0, 1024));
  command->add_option("--json", options.json, "Write every check to this file");
  add_progress(command, options.progress);
}

/// The keys of the problem that is named; else how to list all.
std::string help_on(const std::string& problem) {
  for (const ExactProblem& known : exact_problems())
    if (known.name == problem) return text_of(known);
  return fmt::format("{}vpm exact lists all problems with their keys.",
                     problem.empty() ? "" : fmt::format("There is no problem '{}'. ", problem));
}

void add_exact(CLI::App& app, ExactOptions& options) {
  CLI::App* command = app.add_subcommand("exact", "Solve a problem exactly; without one: list them with their keys");
  command->add_option("problem", options.problem, "Which one");
  command->add_option("arguments", options.arguments, "Its settings: key=value");
  command->add_flag("--json", options.json, "Print JSON");
  command->footer([&options] {
    return "Example: vpm exact slab tau=2 albedo=0.9 solves a slab of optical thickness 2.\n\n" +
           help_on(options.problem);
  });
}

}  // namespace

void declare_commands(CLI::App& app, CommandLine& options) {
  app.set_version_flag("--version", fmt::format("vpm {}", version()));
  app.require_subcommand(1);
  add_render(app, options.render);
  add_view(app, options.view);
  add_merge(app, options.merge);
  add_tonemap(app, options.tonemap);
  add_bake(app, options.bake);
  add_photons(app, options.photons);
  add_fluence(app, options.fluence);
  add_measure(app, options.measure);
  add_compare(app, options.compare);
  add_info(app, options.info);
  add_error(app, options.error);
  add_report(app, options.report);
  add_media(app, options.media);
  add_mesh(app, options.mesh);
  add_validate(app, options.validate);
  add_upgrade(app, options.upgrade);
  add_exact(app, options.exact);
  app.footer(  // last: commands that are added later would have it, too
      "Example: vpm render scenes/smoke.toml --time 20 renders for 20 seconds to smoke.exr and smoke.png.\n"
      "vpm help COMMAND lists the options of a command; scenes/README.md how scenes are written.");
}

}  // namespace vpm::tools
