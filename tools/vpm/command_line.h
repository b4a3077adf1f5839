// The options of all commands, as the command line declares them.
#pragma once

#include "commands.h"

namespace CLI {
class App;
}

namespace vpm::tools {

/// Options of the commands: a parsed command line fills that of the command it names.
struct CommandLine {
  RenderOptions render;
  ViewOptions view;
  MergeOptions merge;
  TonemapOptions tonemap;
  UpgradeOptions upgrade;
  BakeOptions bake;
  PhotonsOptions photons;
  FluenceOptions fluence;
  MeasureOptions measure;
  CompareOptions compare;
  InfoOptions info;
  ErrorOptions error;
  ReportOptions report;
  MediaOptions media;
  MeshOptions mesh;
  ValidateOptions validate;
  ExactOptions exact;
};

/// Declares the commands to `app`; both structures must outlive its parsing.
void declare_commands(CLI::App& app, CommandLine& options);

}  // namespace vpm::tools
