// GLB files before Khronos' own validator, where it is installed (docs/export.md tells how): node is no dependency.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <iostream>

#include "modules/maps/export/export.hpp"
#include "tests/export/export_maps.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temp_folder.hpp"

using namespace ppm;

namespace {

/// Runs a command through the shell's look-up of programs.
std::pair<int, std::string> run(std::vector<std::string> command) {
  command.insert(command.begin(), "/usr/bin/env");
  test::Process process(std::move(command));
  process.wait();
  return {process.code, process.out + process.err};
}

}  // namespace

TEST_CASE("Khronos' validator finds neither error nor warning in our GLB files") {
  if (run({"node", "-e", "require('gltf-validator')"}).first != 0) {
    std::cout << "SKIPPED: node cannot find the package gltf-validator (npm install gltf-validator; set NODE_PATH)\n";
    return;
  }
  test::TempFolder dir;
  std::vector<std::string> command{"node", std::string(PPM_SOURCE_DIR) + "/tests/export/validate_glb.js"};
  for (const int channels : {0, 3})
    for (const auto surface : {Surface::base, Surface::displaced})
      for (const auto& [name, show] : show_names()) {
        if (show == Show::color && channels == 0) continue;
        ExportSettings settings;
        settings.format = ExportFormat::glb;
        settings.surface = surface;
        settings.show = show;
        const auto file = dir / (name + std::to_string(channels) + std::to_string(static_cast<int>(surface)) + ".glb");
        write(export_map(*test::textured_sheet(channels), settings, file, "map.ppm"));
        command.push_back(file.string());
      }
  const auto [code, text] = run(command);
  INFO(text);
  CHECK(code == 0);
}
