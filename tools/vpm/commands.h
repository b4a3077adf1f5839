// The subcommands of vpm: the options of each, and the functions that run them. They return the exit status.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tev_display.h"
#include "vpm/base/progress.h"
#include "vpm/input/view_scene.h"

namespace vpm::tools {

/// Options of all that trace photons or paths through a scene.
struct SceneOptions {
  std::string scene;                   // a scene file
  std::string output;                  // empty: a name made of the scene's in the current folder
  std::vector<std::string> overrides;  // key.path=value
  int threads = 0;                     // 0: all
  std::optional<uint64_t> seed;
  ProgressMode progress = ProgressMode::automatic;
};

/// Options of all that run passes, to an .exr.
struct PassOptions : SceneOptions {
  std::optional<int> passes;
  std::optional<float> exposure;  // of the preview, stops; none: auto_exposure()
};

/// How a run can be watched.
struct WatchOptions {
  std::optional<TevAddress> display;  // of a viewer that shows the picture after each pass
  std::optional<double> preview;      // s, > 0: after so long the files are written again, after the next pass
};

struct RenderOptions : PassOptions {
  WatchOptions watch;
  std::optional<double> seconds;
  std::optional<double> error;      // relative MSE to stop at
  std::string reference;            // .exr: the truth, against which errors are logged; empty: none
  bool automatic = false;           // choose settings: see Automatic of job/choice.h
  std::vector<std::string> layers;  // of known_layers(); of what the camera sees, these are in the scene's place
  bool checkpoint = false;          // keep one next to the image after each pass
  bool overwrite = false;           // begin anew where there is one
  bool resume = false;              // go on from that
  std::string size;                 // "640x480", pixels; empty: the scene's
  std::string crop;                 // "x0,y0,x1,y1", pixels from the upper left, ends excluded; empty: all
  std::optional<int> samples;       // a pixel in each pass
  bool quiet = false;               // say nothing but warnings and errors
  std::string pass_range;           // "64:128": of all passes those of these numbers, the end excluded; empty: all
};
/// kCombinedLayers, and the words of render.layers.
std::vector<std::string> known_layers();
inline constexpr const char* kCombinedLayers = "combined";
/// Renders a scene to an EXR file, with a PNG preview and a JSON report next to it. 130 when interrupted: the finished
/// passes are written.
/// With a checkpoint a killed render loses the pass under way, and goes on to the same bits.
int render_command(const RenderOptions& options);

struct ViewOptions : RenderOptions {  // `scene` is a .vdb, and `automatic` is not asked
  ViewWishes wishes;
  std::string scene_output;  // .toml, for the scene that is made; empty: none
  std::string slice;         // "y=0.25": a drawing of a slice in the place of a picture; empty: none
};
/// Makes a scene around a grid, shows a first picture of it at once, and renders it as render_command() does. Or draws
/// a slice of the grid.
int view_command(const ViewOptions& options);

struct MergeOptions {
  std::vector<std::string> pieces;  // checkpoints
  std::string output;               // .exr; empty: merged.exr in the current folder
  std::string scene;                // .toml; empty: that of the first piece
  std::optional<float> exposure;    // of the preview, stops; none: auto_exposure()
  bool checkpoint = false;          // write one of the whole next to the image
  bool overwrite = false;           // replace one that is there
  int threads = 0;                  // 0: all
};
/// Adds up pieces of a render, in any order, to the picture of one run.
int merge_command(const MergeOptions& options);

struct TonemapOptions {
  std::string picture;            // .exr
  std::string layer;              // of that file; empty: its picture
  std::string output;             // .png
  std::optional<float> exposure;  // stops; none: auto_exposure()
};
/// Writes a picture as a PNG file.
int tonemap_command(const TonemapOptions& options);

struct UpgradeOptions {
  std::vector<std::string> files;  // scenes and experiments (.toml)
  std::string output;              // of one file; empty: each is rewritten in place, and kept as FILE.old
  bool keys = false;               // print the old keys with the new ones
};
/// Rewrites files with the keys of older versions.
int upgrade_command(const UpgradeOptions& options);

struct BakeOptions : PassOptions {
  std::string mesh;      // the name of a shape in the scene
  int resolution = 256;  // texels along an edge
};
/// Bakes the irradiance on a shape into an EXR file over its texture coordinates, with a PNG preview and a JSON report
/// next to it. 130 when interrupted: the finished passes are written.
int bake_command(const BakeOptions& options);

struct PhotonsOptions : SceneOptions {  // to a .ply or .csv
  bool paths = false;                   // flights in the place of stored photons
  int pass = 0;                         // whose photons
};
/// Writes the photons that the maps of a pass store, or the flights of all its photons.
int photons_command(const PhotonsOptions& options);

/// Options of all that count photons pass by pass.
struct CountOptions : SceneOptions {
  int passes = 16;
  std::optional<double> seconds;  // in the place of passes
};

struct FluenceOptions : CountOptions {  // to a .npy or .vdb
  std::vector<float> box;               // x0, y0, z0, x1, y1, z1, m; empty: that of all shapes
  int resolution = 64;                  // cells along its longest edge
  bool flux = false;                    // net flux, too
};
/// Writes the fluence and the absorbed power in the cells of a box.
int fluence_command(const FluenceOptions& options);

struct MeasureOptions : CountOptions {  // to a .json or .html; where no output is named, to none
  bool json = false;                    // print JSON
};
/// Counts the power that passes a scene's detectors, beside what is exact of a slab.
int measure_command(const MeasureOptions& options);

struct CompareOptions {
  std::string experiment;              // an experiment file
  std::string output;                  // folder; made where it is missing
  std::vector<std::string> overrides;  // key.path=value, of the experiment
  int threads = 0;                     // 0: all
  ProgressMode progress = ProgressMode::automatic;
};
/// Runs every method of an experiment on every scene, as often as it asks for, and writes tables of error against cost.
/// Goes on where it was interrupted: 130 then.
int compare_command(const CompareOptions& options);

struct InfoOptions {
  std::string file;                    // a scene or a .vdb
  std::vector<std::string> overrides;  // key.path=value, for scenes
  bool all = false;                    // also stages that a render skips, and the details of grids
};
/// Prints what a file holds; of a scene first what a render of it would run.
int info_command(const InfoOptions& options);

struct ErrorOptions {
  std::vector<std::string> images;     // a picture and its reference; of a series the last is the reference
  std::string layer, reference_layer;  // of the files; empty: their pictures
  bool series = false;
  std::string output;     // .exr for the difference; empty: none. Not of a series
  bool resample = false;  // bring the picture to the size of the reference. Not of a series
  int worst = 5;          // pixels to list
  bool json = false;
};
/// Prints how far pictures are from a reference; of a series also how fast that falls with passes.
int error_command(const ErrorOptions& options);
/// The same of a series (ErrorOptions::series): prints how far pictures are from the last of them, and how that falls
/// with passes.
int compare_series(const ErrorOptions& options);

struct ReportOptions {
  std::string report;  // .json, as render_command() writes it beside its image
  std::string output;  // .html; empty: the report's name
};
/// Writes a page of a render: its report and the picture beside that, to be looked at in a browser.
int report_command(const ReportOptions& options);

struct MediaOptions {
  std::string name;      // of a generator; empty: list them
  int resolution = 128;  // voxels along the longest edge
  std::string output;    // .vdb; empty: NAME.vdb in the current folder
};
/// Writes one of our own generated grids.
int media_command(const MediaOptions& options);

struct MeshOptions {
  std::string name;      // of a generator; empty: list them
  int resolution = 256;  // edges along its side or around its axis
  std::string output;    // .ply; empty: NAME.ply in the current folder
};
/// Writes one of our own generated meshes.
int mesh_command(const MeshOptions& options);

struct ValidateOptions {
  std::optional<int> level;  // 0 to 4; none: all
  std::string only;          // part of the name of each experiment to be run; empty: all of them
  std::string oracles;       // folder of reference numbers to check against instead; empty: none
  bool full = false;         // tight errors
  uint64_t seed = 1;
  double rate = 0.01;  // of false alarms, of the whole run
  int threads = 0;     // 0: all
  std::string json;    // file to write; empty: none
  ProgressMode progress = ProgressMode::automatic;
};
/// Runs the ladder of validation, or all cases of a folder of reference numbers, and prints every check with its
/// verdict. 1 where one fails.
int validate_command(const ValidateOptions& options);
/// Runs all cases of a folder of reference numbers and prints their checks. 1 where a check fails, or where a case was
/// not checked, except the known limits of the framework.
int oracle_command(const ValidateOptions& options);

struct ExactOptions {
  std::string problem;                 // empty: list them with their keys
  std::vector<std::string> arguments;  // key=value
  bool json = false;
};
/// Prints an exact solution with its error bounds.
int exact_command(const ExactOptions& options);

}  // namespace vpm::tools
